#include "structure/body_forces.hpp"

#include <algorithm>

namespace pliant {
namespace {

Vec3 mean_of(std::span<const int> vertices, std::span<const Vec3> positions) {
  Vec3 sum;
  for (int v : vertices) sum += positions[v];
  return sum / static_cast<double>(vertices.size());
}

void share(Vec3 force, std::span<const int> vertices, std::span<Vec3> forces) {
  const Vec3 part = force / static_cast<double>(vertices.size());
  for (int v : vertices) forces[v] += part;
}

Vec3 placed(const DeformableBody& body, Vec3 point) { return body.origin + rotate(body.orientation, point); }

Vec3 along(const DeformableBody& body, const Cord& cord, std::span<const Vec3> positions) {
  const Vec3 end = cord.to.empty() ? placed(body, cord.point) : mean_of(cord.to, positions);
  return end - mean_of(cord.from, positions);
}

}  // namespace

void find_body_forces(const DeformableBody& body, const ShapeState& shape, std::span<Vec3> forces) {
  find_elastic_forces(body, shape, forces);
  add_damping_forces(body, shape, body.velocities, forces);
}

void find_elastic_forces(const DeformableBody& body, const ShapeState& shape, std::span<Vec3> forces) {
  std::fill(forces.begin(), forces.end(), Vec3{});
  body.potentials.add_forces(shape, forces);
  const auto positions = shape.positions();
  for (const Tether& tether : items_of(body.attachments.tethers))
    forces[tether.vertex] += tether.stiffness * (placed(body, tether.anchor) - positions[tether.vertex]);
  for (const Cord& cord : items_of(body.attachments.cords)) {
    const Vec3 span = along(body, cord, positions);
    const double length = norm(span);
    if (length <= cord.rest_length) continue;
    const Vec3 force = (cord.stiffness * (1.0 - cord.rest_length / length)) * span;
    share(force, cord.from, forces);
    if (!cord.to.empty()) share(-force, cord.to, forces);
  }
  for (const Pull& pull : items_of(body.attachments.pulls))
    share(rotate(body.orientation, pull.force), pull.vertices, forces);
}

void add_damping_forces(const DeformableBody& body, const ShapeState& shape, std::span<const Vec3> velocities,
                        std::span<Vec3> forces) {
  for (const Tether& tether : items_of(body.attachments.tethers))
    forces[tether.vertex] -= tether.damping * velocities[tether.vertex];
  if (body.inner_damping == 0) return;
  const auto edges = body.mesh.vertices_of_edge();
  const double* inverse_lengths = shape.inverse_edge_lengths();
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [a, b] = edges[e];
    const Vec3 direction =
        inverse_lengths[e] * Vec3{shape.edge_vectors(0)[e], shape.edge_vectors(1)[e], shape.edge_vectors(2)[e]};
    const Vec3 force = (body.inner_damping * dot(velocities[b] - velocities[a], direction)) * direction;
    forces[a] += force;
    forces[b] -= force;
  }
}

double attachment_energy(const DeformableBody& body, std::span<const Vec3> positions) {
  double sum = 0;
  for (const Tether& tether : items_of(body.attachments.tethers)) {
    const Vec3 stretch = positions[tether.vertex] - placed(body, tether.anchor);
    sum += 0.5 * tether.stiffness * dot(stretch, stretch);
  }
  for (const Cord& cord : items_of(body.attachments.cords)) {
    const double stretch = std::max(0.0, norm(along(body, cord, positions)) - cord.rest_length);
    sum += 0.5 * cord.stiffness * stretch * stretch;
  }
  for (const Pull& pull : items_of(body.attachments.pulls))
    sum -= dot(rotate(body.orientation, pull.force), mean_of(pull.vertices, positions) - body.origin);
  return sum;
}

}  // namespace pliant
