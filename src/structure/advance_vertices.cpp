#include "structure/advance_vertices.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "structure/body_forces.hpp"

namespace pliant {
namespace {

/// What moves the vertices is found for all first, since contact wants to know it.
void find_free_motion(DeformableBody& body, const VertexLoads& loads, double step, std::vector<Vec3>& velocities,
                      std::vector<double>& mobilities) {
  velocities.resize(body.positions.size());
  mobilities.resize(body.positions.size());
  for (std::size_t v = 0; v < body.positions.size(); ++v) {
    body.forces[v] += loads.forces[v];
    if (body.is_pinned(v)) {
      velocities[v] = {};
      mobilities[v] = 0;
      continue;
    }
    const double rate = step / body.masses[v];
    const double slowed = 1.0 / (1.0 + rate * (loads.drag[v] + body.damping));
    velocities[v] = slowed * (body.velocities[v] + rate * (body.forces[v] + loads.drag[v] * loads.flow_velocities[v]));
    mobilities[v] = slowed * rate;
  }
}

}  // namespace

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

void advance_vertices(DeformableBody& body, const ShapeState& shape, const VertexLoads& loads, double step,
                      SurfaceContact& contact, double elapsed) {
  const std::size_t n = body.positions.size();
  find_body_forces(body, shape, body.forces);
  std::vector<Vec3> velocities, pushes(n);
  std::vector<double> mobilities;
  find_free_motion(body, loads, step, velocities, mobilities);
  contact.add_forces({body.positions, velocities, mobilities, elapsed, step}, pushes);
  for (std::size_t v = 0; v < n; ++v) {
    body.forces[v] += pushes[v];
    body.velocities[v] = velocities[v] + mobilities[v] * pushes[v];
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
