#pragma once
#include <span>

#include "potentials/shape_state.hpp"
#include "structure/deformable_body.hpp"

namespace pliant {

/// The forces by which a body acts on its own vertices, and those that the case puts on them: potentials, tethers,
/// cords, pulls, and inner damping at the body's velocities. Loads of the flow, contact and the drag of `damping` are
/// left out. One a vertex, pinned or not; overwrites `forces`.
void find_body_forces(const DeformableBody& body, const ShapeState& shape, std::span<Vec3> forces);

/// Of these, those that do not depend on velocities.
void find_elastic_forces(const DeformableBody& body, const ShapeState& shape, std::span<Vec3> forces);

/// Adds those of inner damping and of the damping of tethers, linear in the velocities. The former act along edges
/// between their ends: momentum and angular momentum stay, energy falls.
void add_damping_forces(const DeformableBody& body, const ShapeState& shape, std::span<const Vec3> velocities,
                        std::span<Vec3> forces);

/// Energy of tethers and cords, and minus the work of pulls from the surface's origin.
double attachment_energy(const DeformableBody& body, std::span<const Vec3> positions);

}  // namespace pliant
