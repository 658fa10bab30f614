#include "loads/surface_traction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/geometry.hpp"

namespace pliant {
namespace {

double equivalent_radius(const TriangleMesh& mesh, std::span<const Vec3> positions) {
  using std::numbers::pi;
  if (mesh.is_closed()) return std::cbrt(3 * std::abs(enclosed_volume(mesh, positions)) / (4 * pi));
  return std::sqrt(total_area(mesh, positions) / (4 * pi));
}

Vec3 viscous_stress(const Mat3& gradient, Vec3 n) {
  const Vec3 transposed{gradient[0].x * n.x + gradient[1].x * n.y + gradient[2].x * n.z,
                        gradient[0].y * n.x + gradient[1].y * n.y + gradient[2].y * n.z,
                        gradient[0].z * n.x + gradient[1].z * n.y + gradient[2].z * n.z};
  return gradient * n + transposed;
}

// Barycentric areas without an allocation a substep.
void add_vertex_areas(const TriangleMesh& mesh, std::span<const Vec3> positions, double weight,
                      std::span<VertexLoad> loads) {
  for (const Face& face : mesh.vertices_of_face()) {
    const double share = weight * norm(face_vector(face, positions)) / 6;
    for (int v : face) loads[static_cast<std::size_t>(v)].drag += share;
  }
}

}  // namespace

SurfaceTraction::SurfaceTraction(const TractionConfig& config, double viscosity, double probe_length,
                                 const TriangleMesh& mesh, std::span<const Vec3> reference)
    : config_(config),
      viscosity_(viscosity),
      probe_length_(config.probe_length > 0 ? config.probe_length : probe_length),
      reference_areas_(vertex_areas(mesh, reference)) {
  const auto faces = static_cast<std::size_t>(mesh.n_faces());
  std::size_t points = 0;
  switch (config.form) {
    case TractionForm::none: break;
    case TractionForm::drag:
      points = reference.size();
      drag_per_area_ = config.coefficient * viscosity / equivalent_radius(mesh, reference);
      break;
    case TractionForm::one_sided:
    case TractionForm::gradient: points = mesh.is_closed() ? faces : 2 * faces; break;
  }
  points_.resize(points);
  samples_.resize(points);
}

void SurfaceTraction::sample(const FlowSampler& flow, const TriangleMesh& mesh, std::span<const Vec3> positions) {
  if (config_.form == TractionForm::none) return;
  if (config_.form == TractionForm::drag) {
    std::copy(positions.begin(), positions.end(), points_.begin());
  } else {
    const auto faces = mesh.vertices_of_face();
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const Vec3 n = normalized(face_vector(faces[f], positions)), c = face_centroid(faces[f], positions);
      points_[f] = c + probe_length_ * n;
      if (!mesh.is_closed()) points_[faces.size() + f] = c - probe_length_ * n;
    }
  }
  flow.sample(points_, samples_);
}

FlowSample SurfaceTraction::at(std::size_t point, Vec3 position) const {
  FlowSample s = samples_[point];
  s.velocity += s.gradient * (position - points_[point]);
  return s;
}

void SurfaceTraction::evaluate(const TriangleMesh& mesh, std::span<const Vec3> positions,
                               std::span<VertexLoad> loads) const {
  std::fill(loads.begin(), loads.end(), VertexLoad{});
  if (config_.form == TractionForm::drag) evaluate_drag(mesh, positions, loads);
  else if (config_.form != TractionForm::none) evaluate_faces(mesh, positions, loads);
}

void SurfaceTraction::evaluate_drag(const TriangleMesh& mesh, std::span<const Vec3> positions,
                                    std::span<VertexLoad> loads) const {
  if (config_.area == DragArea::current) add_vertex_areas(mesh, positions, drag_per_area_, loads);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (config_.area == DragArea::reference) loads[v].drag = drag_per_area_ * reference_areas_[v];
    loads[v].drag_velocity = at(v, positions[v]).velocity;
  }
}

void SurfaceTraction::evaluate_faces(const TriangleMesh& mesh, std::span<const Vec3> positions,
                                     std::span<VertexLoad> loads) const {
  const auto faces = mesh.vertices_of_face();
  const int sides = mesh.is_closed() ? 1 : 2;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Vec3 vector = face_vector(faces[f], positions), c = face_centroid(faces[f], positions);
    const double area = 0.5 * norm(vector);
    for (int side = 0; side < sides; ++side) {
      const Vec3 n = (side == 0 ? 1.0 : -1.0) * normalized(vector);
      const FlowSample s = at(static_cast<std::size_t>(side) * faces.size() + f, c + probe_length_ * n);
      Vec3 force = (-s.pressure * area) * n;
      double drag = 0;
      if (config_.form == TractionForm::gradient) force += (viscosity_ * area) * viscous_stress(s.gradient, n);
      else drag = viscosity_ * area / probe_length_;
      for (int v : faces[f]) {
        VertexLoad& load = loads[static_cast<std::size_t>(v)];
        load.force += force / 3.0;
        load.drag += drag / 3;
        load.drag_velocity += (drag / 3) * s.velocity;  // divided by the whole drag of the vertex below
      }
    }
  }
  if (config_.form != TractionForm::one_sided) return;
  for (VertexLoad& load : loads)
    if (load.drag > 0) load.drag_velocity = load.drag_velocity / load.drag;
}

double SurfaceTraction::largest_drag() const {
  if (config_.form != TractionForm::drag) return 0;
  return drag_per_area_ * *std::max_element(reference_areas_.begin(), reference_areas_.end());
}

}  // namespace pliant
