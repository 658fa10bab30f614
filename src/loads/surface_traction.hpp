#pragma once
#include <span>
#include <vector>

#include "config/case_config.hpp"
#include "mesh/triangle_mesh.hpp"
#include "transfer/flow_sample.hpp"

namespace pliant {

/// The load of the flow on one vertex: force + drag (drag_velocity - v), v the velocity of the vertex. The drag part is
/// linear in v, so that it can be integrated implicitly.
struct VertexLoad {
  Vec3 force;
  double drag = 0;
  Vec3 drag_velocity;
};

/// The undisturbed flow's traction on a surface (numerics.md, sections 5 and 8).
///
///   drag       c (u(x) - v) at each vertex, c = c_d mu A / R; A a third of the faces around it, R the radius of the
///              sphere of the same volume (closed) or area (open) as the reference shape
///   one-sided  (-p n + mu (u(x + h n) - v) / h) A a face, h the probe length; a third to each vertex
///   gradient   (-p n + mu (grad u + grad u^T) n) A a face, p and grad u at x + h n; a third to each vertex
///
/// Open surfaces are loaded on both sides: the difference of p, the sum of the one-sided terms, the difference of the
/// stresses.
class SurfaceTraction {
 public:
  /// `viscosity` is dynamic; `probe_length` > 0 replaces the configuration's 0 (the mean grid spacing).
  SurfaceTraction(const TractionConfig& config, double viscosity, double probe_length, const TriangleMesh& mesh,
                  std::span<const Vec3> reference);

  /// Takes the flow at the points that the form needs, once a fluid step: between samples it is continued linearly, as
  /// u(x0) + grad u (x - x0). Collective.
  void sample(const FlowSampler& flow, const TriangleMesh& mesh, std::span<const Vec3> positions);

  /// Loads at the present positions (n_vertices of them and of loads).
  void evaluate(const TriangleMesh& mesh, std::span<const Vec3> positions, std::span<VertexLoad> loads) const;

  /// The largest drag coefficient of a vertex in the reference shape: 0 if the form has none.
  double largest_drag() const;
  double probe_length() const { return probe_length_; }

 private:
  FlowSample at(std::size_t point, Vec3 position) const;
  void evaluate_drag(const TriangleMesh& mesh, std::span<const Vec3> positions, std::span<VertexLoad> loads) const;
  void evaluate_faces(const TriangleMesh& mesh, std::span<const Vec3> positions, std::span<VertexLoad> loads) const;

  TractionConfig config_;
  double viscosity_, probe_length_, drag_per_area_ = 0;
  std::vector<double> reference_areas_;
  std::vector<Vec3> points_;
  std::vector<FlowSample> samples_;
};

}  // namespace pliant
