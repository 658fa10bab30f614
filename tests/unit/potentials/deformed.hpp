#pragma once
#include <random>
#include <vector>

#include "mesh/shapes/icosphere.hpp"
#include "mesh/surface.hpp"
#include "potentials/shape_state.hpp"
#include "unit/mesh/patches.hpp"

namespace pliant {

/// Positions moved at random by at most `amplitude` along each axis.
inline std::vector<Vec3> shaken(std::vector<Vec3> positions, double amplitude, unsigned seed) {
  std::mt19937 random(seed);
  const auto next = [&] { return amplitude * (2.0 * random() / 4294967296.0 - 1.0); };
  for (Vec3& x : positions) x += Vec3{next(), next(), next()};
  return positions;
}

/// A reference and a strongly deformed state on one mesh, away from the origin.
struct DeformedSurface {
  TriangleMesh mesh;
  std::vector<Vec3> reference, positions;
};

inline DeformedSurface deformed_sphere(int frequency, unsigned seed) {
  auto sphere = make_icosphere(frequency, 1.0);
  auto positions = shaken(sphere.positions, 0.15 / frequency, seed);
  for (Vec3& x : positions) x = Vec3{1.3 * x.x + 0.2 * x.z + 3, 0.9 * x.y - 2, 0.8 * x.z + 1};
  return {sphere.mesh, sphere.positions, positions};
}

inline DeformedSurface deformed_patch(unsigned seed) {
  auto patch = make_lattice_patch(4);
  auto reference = shaken(patch.positions, 0.1, seed + 1);
  return {patch.mesh, reference, shaken(patch.positions, 0.25, seed)};
}

template <class Potential>
std::vector<Vec3> forces_of(const Potential& potential, const TriangleMesh& mesh, std::span<const Vec3> positions) {
  std::vector<Vec3> forces(positions.size());
  potential.add_forces(ShapeState(mesh, positions), forces);
  return forces;
}

}  // namespace pliant
