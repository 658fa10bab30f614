#include "coupling/forced_vertices.hpp"

#include <algorithm>

#include "coupling/nodal_forces.hpp"
#include "mesh/geometry.hpp"
#include "structure/advance_vertices.hpp"
#include "structure/stable_time_step.hpp"

namespace pliant {

void advance_forced(Body& body, const BodyKind& kind, const NodalSurroundings& surroundings, SurfaceContact* contact,
                    double step) {
  auto& surface = body.surface;
  const std::size_t n_vertices = surface.positions.size();
  const int substeps = surface.substeps.value_or(substeps_for(step, stable_time_step(surface, {}), surface.name));
  const double h = step / substeps;
  ShapeState shape(surface.mesh);
  const auto before = surface.velocities;
  const auto mobilities = contact != nullptr ? mobilities_of(surface, surface.masses, h) : std::vector<double>{};
  std::vector<Vec3> pushes(n_vertices);
  for (int n = 0; n < substeps; ++n) {
    shape.update(surface.positions);
    find_nodal_forces(body, kind, shape, surroundings.gravity, surroundings.fluid_density, surface.forces);
    for (std::size_t v = 0; v < n_vertices; ++v) {
      surface.forces[v] += body.flow_forces[v];
      if (surface.is_pinned(v)) continue;
      surface.velocities[v] += (h / surface.masses[v]) * surface.forces[v];
    }
    if (contact != nullptr) {
      std::fill(pushes.begin(), pushes.end(), Vec3{});
      contact->add_forces({surface.positions, surface.velocities, mobilities, n * h, h}, pushes);
      for (std::size_t v = 0; v < n_vertices; ++v) {
        surface.velocities[v] += mobilities[v] * pushes[v];
        surface.forces[v] += pushes[v];
      }
    }
    if (kind.config.held) remove_mean(surface.masses, surface.velocities);
    for (std::size_t v = 0; v < n_vertices; ++v) surface.positions[v] += h * surface.velocities[v];
  }
  body.accelerations.resize(n_vertices);
  for (std::size_t v = 0; v < n_vertices; ++v) body.accelerations[v] = (1 / step) * (surface.velocities[v] - before[v]);
  body.pose.center = mean_position(surface.positions);
  require_finite(surface);
}

void adopt_probe_forces(Body& body) {
  body.flow_forces.assign(body.surface.positions.size(), Vec3{});
  const auto& faces = body.surface.mesh.vertices_of_face();
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (int v : faces[f]) body.flow_forces[static_cast<std::size_t>(v)] += body.stresses.forces[f] / 3.0;
}

}  // namespace pliant
