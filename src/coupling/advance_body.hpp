#pragma once
#include "coupling/bodies.hpp"

namespace pliant {

/// Uniform accelerations that act in the box.
struct Surroundings {
  Vec3 gravity;  ///< bodies feel it times their mass less that of the fluid they displace
  Vec3 driving;  ///< of the fluid; stands for a pressure gradient, which displaced fluid hands on to bodies
  double fluid_density = 1;
};

/// All that moves a rigid or hinged body besides springs and dampers, about its centre: hydrodynamic load from the
/// source that the case names, weight less buoyancy, the driving pressure gradient, contact.
RigidLoad total_load(const Body& body, const BodyKind& kind, const Surroundings& surroundings);

/// Puts prescribed bodies where they are at time `time`.
void move_prescribed(Bodies& bodies, double time);

/// Moves a rigid or hinged body through a step under a constant load.
void advance_free(Body& body, const BodyKind& kind, const RigidLoad& load, double step);

/// Throws RunError that names the body if its state is not finite.
void require_finite(const Body& body);

}  // namespace pliant
