#pragma once
#include "structure/deformable_body.hpp"
#include "structure/surface_contact.hpp"
#include "structure/vertex_loads.hpp"

namespace pliant {

/// One substep of m x'' = F_int + F_load + c (u - v) - d v, semi-implicit Euler with the drag c and the damping d
/// implicit:
///   v' = (v + h/m (F_int + F_load + c u)) / (1 + h (c + d)/m),  x' = x + h v'.
/// Symplectic without drag; with it the final slip is exact for any h. `shape` must hold the body's present positions;
/// afterwards body.forces are F_int + F_load of the start of the substep, and `shape` must be updated. Pinned vertices
/// stay; their forces are what the pins have to bear.
void advance_vertices(DeformableBody& body, const ShapeState& shape, const VertexLoads& loads, double step);

/// The same with contact: its forces act over the velocities that a substep would end with without it. `elapsed`: time
/// since contact.begin. body.forces then hold contact as well.
void advance_vertices(DeformableBody& body, const ShapeState& shape, const VertexLoads& loads, double step,
                      SurfaceContact& contact, double elapsed);

/// m v^2 / 2 of all vertices.
double kinetic_energy(const DeformableBody& body);

/// Throws RunError naming the body and the likely cause if a position is not finite.
void require_finite(const DeformableBody& body);

}  // namespace pliant
