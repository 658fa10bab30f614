#include "loads/traction.hpp"

#include <fmt/format.h>

#include "mesh/geometry.hpp"

namespace pliant {
namespace {

Vec3 unit_normal(const ShapeState& shape, std::size_t face) {
  return shape.inverse_length(face) * shape.face_vector(face);
}

double area(const ShapeState& shape, std::size_t face) { return 0.5 / shape.inverse_length(face); }

/// A third of the area of every face to each of its vertices.
void add_vertex_areas(const ShapeState& shape, std::span<double> areas) {
  const auto faces = shape.mesh().vertices_of_face();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const double third = area(shape, f) / 3.0;
    for (int v : faces[f]) areas[v] += third;
  }
}

std::vector<Vec3> probe_ends(const DeformableBody& body) {
  const auto normals = face_normals(body.mesh, body.positions);
  auto points = face_centroids(body.mesh, body.positions);
  for (std::size_t f = 0; f < points.size(); ++f) points[f] += body.traction.probe_length * normals[f];
  return points;
}

}  // namespace

std::vector<Vec3> traction_points(const DeformableBody& body) {
  switch (body.traction.form) {
    case TractionForm::none:
      return {};
    case TractionForm::drag:
      return body.positions;
    default:
      return probe_ends(body);
  }
}

std::string explain_outside(const TractionConfig& traction) {
  if (traction.form == TractionForm::drag) return "the body has left the box";
  return fmt::format(
      "the body, with its probes of length {:.4g}, has come too close to a side of the box; shorten "
      "traction.probe_length or make the box larger",
      traction.probe_length);
}

Traction::Traction(const DeformableBody& body, const FlowSampler& flow, const FluidConfig& fluid)
    : viscosity_(fluid.viscosity), points_(traction_points(body)), samples_(points_.size()) {
  flow.sample(points_, samples_);
}

Traction::Traction(std::span<const Vec3> points, std::span<const FlowSample> samples, const FluidConfig& fluid)
    : viscosity_(fluid.viscosity), points_(points.begin(), points.end()), samples_(samples.begin(), samples.end()) {}

void Traction::evaluate(const DeformableBody& body, const ShapeState& shape, VertexLoads& loads) const {
  loads.assign(body.positions.size());
  switch (body.traction.form) {
    case TractionForm::none:
      return;
    case TractionForm::drag:
      return evaluate_drag(body, shape, loads);
    case TractionForm::automatic:
    case TractionForm::quadratic:
    case TractionForm::one_sided:
      return evaluate_one_sided(body, shape, loads);
    case TractionForm::gradient:
      return evaluate_gradient(shape, loads);
  }
}

void Traction::evaluate_drag(const DeformableBody& body, const ShapeState& shape, VertexLoads& loads) const {
  const double scale = body.traction.coefficient * viscosity_ / body.radius;
  if (body.traction.area == DragArea::current) {
    add_vertex_areas(shape, loads.drag);
  } else {
    loads.drag = body.reference_areas;
  }
  for (std::size_t v = 0; v < points_.size(); ++v) {
    loads.drag[v] *= scale;
    loads.flow_velocities[v] = velocity_at(v, shape.positions()[v]);
  }
}

void Traction::evaluate_one_sided(const DeformableBody& body, const ShapeState& shape, VertexLoads& loads) const {
  const auto faces = body.mesh.vertices_of_face();
  const double length = body.traction.probe_length;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Vec3 normal = unit_normal(shape, f);
    const double third = area(shape, f) / 3.0, drag = viscosity_ * third / length;
    const Vec3 velocity = velocity_at(f, face_centroid(faces[f], shape.positions()) + length * normal);
    for (int v : faces[f]) {
      loads.forces[v] -= (samples_[f].pressure * third) * normal;
      loads.drag[v] += drag;
      loads.flow_velocities[v] += drag * velocity;
    }
  }
  for (std::size_t v = 0; v < loads.drag.size(); ++v)
    if (loads.drag[v] > 0) loads.flow_velocities[v] *= 1.0 / loads.drag[v];
}

void Traction::evaluate_gradient(const ShapeState& shape, VertexLoads& loads) const {
  const auto faces = shape.mesh().vertices_of_face();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Vec3 normal = unit_normal(shape, f);
    const Mat3& gradient = samples_[f].gradient;
    const Vec3 along = gradient * normal;
    const Vec3 across = normal.x * gradient[0] + normal.y * gradient[1] + normal.z * gradient[2];
    const Vec3 force = (area(shape, f) / 3.0) * (viscosity_ * (along + across) - samples_[f].pressure * normal);
    for (int v : faces[f]) loads.forces[v] += force;
  }
}

}  // namespace pliant
