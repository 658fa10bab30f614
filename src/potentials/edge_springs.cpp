#include "potentials/edge_springs.hpp"

#include "mesh/geometry.hpp"

namespace pliant {

EdgeSprings EdgeSprings::uniform(const TriangleMesh& mesh, std::span<const Vec3> reference, double stiffness,
                                 double fraction) {
  EdgeSprings springs{std::vector<double>(mesh.n_edges(), stiffness), edge_lengths(mesh, reference)};
  for (double& length : springs.rest_length) length *= fraction;
  return springs;
}

double EdgeSprings::energy(const ShapeState& shape) const {
  const auto edges = shape.mesh().vertices_of_edge();
  double sum = 0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const double stretch = norm(shape.positions()[edges[e][1]] - shape.positions()[edges[e][0]]) - rest_length[e];
    sum += 0.5 * stiffness[e] * stretch * stretch;
  }
  return sum;
}

void EdgeSprings::add_forces(const ShapeState& shape, std::span<Vec3> forces) const {
  const auto edges = shape.mesh().vertices_of_edge();
  const auto positions = shape.positions();
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [a, b] = edges[e];
    const Vec3 along = positions[b] - positions[a];
    // The branch keeps springs of rest length 0 finite when their ends meet.
    const double tension = rest_length[e] > 0 ? stiffness[e] * (1.0 - rest_length[e] / norm(along)) : stiffness[e];
    forces[a] += tension * along;
    forces[b] -= tension * along;
  }
}

}  // namespace pliant
