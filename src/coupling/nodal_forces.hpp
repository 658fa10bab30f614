#pragma once
#include <span>
#include <vector>

#include "coupling/body.hpp"
#include "potentials/shape_state.hpp"

namespace pliant {

/// What acts on the vertices of a deformable body besides the flow: its own forces, its damping, and its weight less
/// that of the fluid which its thickness displaces. Overwrites `forces`, one a vertex. `shape` must hold the body's
/// present positions.
void find_nodal_forces(const Body& body, const BodyKind& kind, const ShapeState& shape, Vec3 gravity,
                       double fluid_density, std::span<Vec3> forces);

/// Change of the vertices' velocities by a unit of force over a step; none for pinned ones.
std::vector<double> mobilities_of(const DeformableBody& body, std::span<const double> masses, double step);

/// Takes the mean, weighted by mass, from velocities.
void remove_mean(std::span<const double> masses, std::span<Vec3> velocities);

/// Moves the vertices of a closed body by as little as possible, weighted by their areas, so that it encloses `volume`;
/// pinned ones stay, and those that are marked, if any are. Returns the volume that this adds.
double restore_volume(DeformableBody& body, double volume, std::span<const std::uint8_t> marked = {});

}  // namespace pliant
