#pragma once
#include "coupling/bodies.hpp"
#include "loads/probe_loads.hpp"
#include "structure/surface_contact.hpp"

namespace pliant {

/// What the step of a deformable body needs to know of the case.
struct NodalSurroundings {
  Vec3 gravity;
  double fluid_density = 1;
};

/// Moves a deformable body, which the flow is forced to follow, through a fluid step by Newton's law under
/// body.flow_forces, constant, its own forces and those of contact, if there is any, in as many substeps as its
/// stiffness asks for. Throws RunError.
void advance_forced(Body& body, const BodyKind& kind, const NodalSurroundings& surroundings, SurfaceContact* contact,
                    double step);

/// Sets body.flow_forces from the stress that probes found on its faces: a third to each vertex.
void adopt_probe_forces(Body& body);

}  // namespace pliant
