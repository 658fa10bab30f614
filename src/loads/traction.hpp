#pragma once
#include <span>
#include <string>
#include <vector>

#include "config/case_config.hpp"
#include "potentials/shape_state.hpp"
#include "structure/deformable_body.hpp"
#include "structure/vertex_loads.hpp"
#include "transfer/flow_sample.hpp"

namespace pliant {

/// Where the traction of a body needs the flow: its vertices (drag) or the ends of its probes, a face each.
std::vector<Vec3> traction_points(const DeformableBody& body);

/// Why such a point may be outside the box, and what to do.
std::string explain_outside(const TractionConfig& traction);

/// What the flow does to a body that does not act on it, during one fluid step, in the form that body.traction asks
/// for:
/// - drag: c (u(x) - v) at each vertex, c = c_d mu A / R, with R the radius of the start and A the vertex's area (a
/// third
///   of the faces around it), of the start or of now as traction.area says;
/// - one_sided: per face (mu (u(x + h n) - v)/h - p n) A, a third to each vertex, with v of the vertex;
/// - gradient: per face (mu (grad u + grad u^T) n - p n) A at x + h n, a third to each vertex.
/// x is the vertex or the face's centroid, n the outward normal, h the probe length.
///
/// The flow stands still during a fluid step: it is sampled once, at the start, and between samples and moved points
/// u is continued by its gradient (exact for linear flows; else the error is second order in the motion of one step).
class Traction {
 public:
  /// Samples the flow for the body as it is. Collective over the ranks.
  Traction(const DeformableBody& body, const FlowSampler& flow, const FluidConfig& fluid);
  /// From the flow at traction_points(body).
  Traction(std::span<const Vec3> points, std::span<const FlowSample> samples, const FluidConfig& fluid);

  /// Sets the loads at the shape's positions.
  void evaluate(const DeformableBody& body, const ShapeState& shape, VertexLoads& loads) const;

 private:
  Vec3 velocity_at(std::size_t i, Vec3 point) const {
    return samples_[i].velocity + samples_[i].gradient * (point - points_[i]);
  }
  void evaluate_drag(const DeformableBody& body, const ShapeState& shape, VertexLoads& loads) const;
  void evaluate_one_sided(const DeformableBody& body, const ShapeState& shape, VertexLoads& loads) const;
  void evaluate_gradient(const ShapeState& shape, VertexLoads& loads) const;

  double viscosity_;
  std::vector<Vec3> points_;  // vertices (drag) or ends of probes, a face each
  std::vector<FlowSample> samples_;
};

}  // namespace pliant
