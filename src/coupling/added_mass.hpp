#pragma once
#include <string>

#include "coupling/body.hpp"

namespace pliant {

/// Fluid that a rigid or hinged body moves along, over the body's own mass (rigid) or inertia (hinge). Estimates: half
/// of the displaced fluid for closed bodies, for open ones the fluid of a ball's slice, rho A sqrt(A) / 2; and what
/// markers take along on a grid of that spacing, which is most of it where a body is few cells wide.
double added_mass_ratio(const BodyKind& kind, double fluid_density, double spacing);

/// Above this ratio "auto" couples strongly. Loose coupling answers an acceleration one step late and multiplies it by
/// -(ratio - virtual) / (1 + virtual) if the flow follows the markers at once: it would fail from 1 on. Where forcing
/// leaves a slip, the flow follows later than the inner fluid's inertia is taken, and a body as heavy as the fluid is
/// swung up slowly: a sphere (0.5) by a factor of 30 a shear time, a prolate spheroid of ratio 2 within 150 steps, both
/// at nu dt / dx^2 of 2.5 to 7. At 0.45 both calm down.
inline constexpr double largest_loose_ratio = 0.45;

/// Above this ratio of the flow's own step to the one that force-spreading is stable with "auto" moves a membrane with
/// mass by local-mass: it holds larger steps, but damps more and slips (docs/coupling.md).
inline constexpr double largest_stiffness = 4;

/// Mass of a wall over rho R, R = 3 V/A or the root of an open surface's area: below the first loose coupling fails at
/// any step, below the second it is marginal.
inline constexpr double least_loose_wall = 0.5, sure_loose_wall = 1;
double wall_mass_ratio(const BodyKind& kind, double fluid_density);

/// The largest fluid step that force-spreading takes with a body.
double force_spreading_limit(const BodyKind& kind);

/// The coupling of a body, "auto" resolved; `reason` says why in a sentence.
CouplingKind choose_coupling(const BodyKind& kind, std::string& reason);

}  // namespace pliant
