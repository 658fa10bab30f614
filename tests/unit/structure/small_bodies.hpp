#pragma once
#include "mesh/geometry.hpp"
#include "structure/deformable_body.hpp"

namespace pliant {

/// A body at rest with the same mass on every vertex, without potentials.
inline DeformableBody make_plain_body(const Surface& surface, double mass) {
  DeformableBody body;
  body.name = "test";
  body.mesh = surface.mesh;
  body.positions = body.reference = surface.positions;
  body.velocities.resize(body.positions.size());
  body.forces.resize(body.positions.size());
  body.masses.assign(body.positions.size(), mass);
  body.reference_areas = vertex_areas(body.mesh, body.positions);
  body.radius = 1;
  body.traction.form = TractionForm::none;
  return body;
}

/// A regular tetrahedron with edges of length 1.
inline Surface make_tetrahedron() {
  const double r = 1.0 / std::sqrt(3.0), h = std::sqrt(2.0 / 3.0);
  return {TriangleMesh(4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}),
          {{r, 0, 0}, {-r / 2, 0.5, 0}, {-r / 2, -0.5, 0}, {0, 0, h}}};
}

}  // namespace pliant
