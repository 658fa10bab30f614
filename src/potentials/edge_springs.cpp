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

void EdgeSprings::add_stress(const ShapeState& shape, InnerStress& stress) const {
  const double* inverse = shape.inverse_edge_lengths();
  // The choice keeps springs of rest length 0 finite when their ends meet.
  for (std::size_t e = 0; e < rest_length.size(); ++e)
    stress.pull[e] += stiffness[e] * (1.0 - (rest_length[e] > 0 ? rest_length[e] * inverse[e] : 0.0));
}

void EdgeSprings::add_forces(const ShapeState& shape, std::span<Vec3> forces) const {
  add_forces_alone(*this, shape, forces);
}

}  // namespace pliant
