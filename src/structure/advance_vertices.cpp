#include "structure/advance_vertices.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "structure/body_forces.hpp"

namespace pliant {

void advance_vertices(DeformableBody& body, const ShapeState& shape, const VertexLoads& loads, double step) {
  find_body_forces(body, shape, body.forces);
  for (std::size_t v = 0; v < body.positions.size(); ++v) {
    body.forces[v] += loads.forces[v];
    if (body.is_pinned(v)) {
      body.velocities[v] = {};
      continue;
    }
    const double rate = step / body.masses[v];
    const Vec3 driven = body.velocities[v] + rate * (body.forces[v] + loads.drag[v] * loads.flow_velocities[v]);
    body.velocities[v] = driven / (1.0 + rate * (loads.drag[v] + body.damping));
    body.positions[v] += step * body.velocities[v];
  }
}

double kinetic_energy(const DeformableBody& body) {
  double twice = 0;
  for (std::size_t v = 0; v < body.velocities.size(); ++v)
    twice += body.masses[v] * dot(body.velocities[v], body.velocities[v]);
  return 0.5 * twice;
}

void require_finite(const DeformableBody& body) {
  for (std::size_t v = 0; v < body.positions.size(); ++v) {
    const Vec3 x = body.positions[v];
    if (!std::isfinite(x.x + x.y + x.z))
      throw RunError(
          fmt::format("body '{}': the position of vertex {} is no longer a number; the motion of its vertices is "
                      "unstable: set more substeps, or softer potentials, or a larger mass_per_vertex",
                      body.name, v));
  }
}

}  // namespace pliant
