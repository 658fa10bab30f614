#include "coupling/nodal_forces.hpp"

#include <cmath>

#include "mesh/geometry.hpp"
#include "structure/body_forces.hpp"

namespace pliant {

void find_nodal_forces(const Body& body, const BodyKind& kind, const ShapeState& shape, Vec3 gravity,
                       double fluid_density, std::span<Vec3> forces) {
  const auto& surface = body.surface;
  find_body_forces(surface, shape, forces);
  const double displaced = fluid_density * kind.config.material.thickness;
  for (std::size_t v = 0; v < forces.size(); ++v) {
    const double weight = surface.masses[v] - displaced * surface.reference_areas[v];
    forces[v] += weight * gravity - surface.damping * surface.velocities[v];
  }
}

std::vector<double> mobilities_of(const DeformableBody& body, std::span<const double> masses, double step) {
  std::vector<double> mobilities(masses.size());
  for (std::size_t v = 0; v < masses.size(); ++v) mobilities[v] = body.is_pinned(v) ? 0.0 : step / masses[v];
  return mobilities;
}

void remove_mean(std::span<const double> masses, std::span<Vec3> velocities) {
  Vec3 momentum;
  double mass = 0;
  for (std::size_t v = 0; v < velocities.size(); ++v) {
    momentum += masses[v] * velocities[v];
    mass += masses[v];
  }
  for (Vec3& velocity : velocities) velocity -= momentum / mass;
}

// With the areas as weights the least motion is along the gradient of the volume over the area: a vertex's normal.
double restore_volume(DeformableBody& body, double volume, std::span<const std::uint8_t> marked) {
  const auto stays = [&](std::size_t v) { return body.is_pinned(v) || (!marked.empty() && marked[v] != 0); };
  constexpr int most_steps = 5;
  constexpr double tolerance = 1e-14;
  const double first = enclosed_volume(body.mesh, body.positions);
  double present = first;
  for (int n = 0; n < most_steps && std::abs(present - volume) > tolerance * std::abs(volume); ++n) {
    const auto areas = vertex_areas(body.mesh, body.positions);
    const auto gradient = volume_gradient(body.mesh, body.positions);
    double slope = 0;
    for (std::size_t v = 0; v < gradient.size(); ++v)
      if (!stays(v)) slope += dot(gradient[v], gradient[v]) / areas[v];
    if (!(slope > 0)) break;
    const double amount = (volume - present) / slope;
    for (std::size_t v = 0; v < gradient.size(); ++v)
      if (!stays(v)) body.positions[v] += (amount / areas[v]) * gradient[v];
    present = enclosed_volume(body.mesh, body.positions);
  }
  return present - first;
}

}  // namespace pliant
