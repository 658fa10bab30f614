#include "structure/body_forces.hpp"

#include <algorithm>

namespace pliant {

void find_body_forces(const DeformableBody& body, const ShapeState& shape, std::span<Vec3> forces) {
  std::fill(forces.begin(), forces.end(), Vec3{});
  body.potentials.add_forces(shape, forces);
}

}  // namespace pliant
