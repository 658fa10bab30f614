#pragma once
#include <span>

#include "potentials/shape_state.hpp"
#include "structure/deformable_body.hpp"

namespace pliant {

/// The forces by which a body acts on its own vertices, and those that the case puts on them; loads of the flow,
/// contact and the drag of `damping` are left out. One a vertex; overwrites `forces`.
void find_body_forces(const DeformableBody& body, const ShapeState& shape, std::span<Vec3> forces);

}  // namespace pliant
