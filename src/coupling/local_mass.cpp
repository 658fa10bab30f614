#include "coupling/local_mass.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "mesh/geometry.hpp"
#include "parallel/agree.hpp"
#include "structure/stable_time_step.hpp"

namespace pliant {

int local_mass_substeps(double alpha, double step, double undamped_limit, const std::string& body) {
  // The parts of the flow's substeps are 8, 2 and 5 fifteenths.
  constexpr int parts = 15;
  const double limit = std::numbers::sqrt2 / 2 * undamped_limit;  // omega step = sqrt(2)
  return static_cast<int>(std::lround(alpha * parts)) * substeps_for(step / parts, limit, body);
}

LocalMass::LocalMass(const Grid& grid, const CaseConfig& config, Bodies& bodies, Contact& contact)
    : SoftBodies(grid, config, bodies, contact, CouplingKind::local_mass) {}

// Symplectic Euler, with the layer as part of the mass. The flow's acceleration in this substep comes evenly over it:
// the pressure that bears a wall and the force that it bears would else take turns, and the wall be somewhere else in
// between. With all of it at the beginning elastic vibrations gained energy at any mass. Forces are those in the middle
// of a step, by the velocity at its beginning: that damps what steps do not resolve, (omega step)^2/2 a step, which
// could gain energy still. Stable up to omega step = sqrt(2).
void LocalMass::advance(const VertexTransfer::Part& part, double alpha, double dt) {
  auto& surface = part.body->surface;
  const std::size_t n_vertices = surface.positions.size();
  forces_.resize(n_vertices);
  masses_ = layered_masses(part);
  const int substeps =
      surface.substeps.value_or(local_mass_substeps(alpha, dt, part.kind->layered_limit, surface.name));
  const double step = alpha * dt / substeps;
  auto* contact = contact_.of(*part.body);
  const auto mobilities = contact != nullptr ? mobilities_of(surface, masses_, step) : std::vector<double>{};
  for (int n = 0; n < substeps; ++n) {
    before_ = surface.positions;
    for (std::size_t v = 0; v < n_vertices; ++v) surface.positions[v] += (0.5 * step) * surface.velocities[v];
    find_nodal_forces(*part.body, *part.kind, shape_of(part), gravity_, density_, forces_);
    if (part.kind->config.separates) remove_mean_pressure(part, forces_);
    surface.positions.swap(before_);
    for (std::size_t v = 0; v < n_vertices; ++v) {
      if (surface.is_pinned(v)) continue;
      surface.velocities[v] += (1.0 / substeps) * by_flow_[v] + (step / masses_[v]) * forces_[v];
    }
    if (contact != nullptr) {
      pushes_.assign(n_vertices, Vec3{});
      contact->add_forces({surface.positions, surface.velocities, mobilities, elapsed_ + n * step, step, masses_},
                          pushes_);
      for (std::size_t v = 0; v < n_vertices; ++v) surface.velocities[v] += mobilities[v] * pushes_[v];
    }
    for (std::size_t v = 0; v < n_vertices; ++v) surface.positions[v] += step * surface.velocities[v];
  }
  std::copy(forces_.begin(), forces_.end(), surface.forces.begin());
}

void LocalMass::before(const Substep& substep, const FlowState& flow) {
  if (substep.index > 0) place();
  transfer_.find_velocities(flow.u.view(), flow.v.view(), flow.w.view(), flow_before_);
}

void LocalMass::predicted(const Substep& substep, double dt, View<FaceX> u, View<FaceY> v, View<FaceZ> w) {
  transfer_.find_velocities(u, v, w, velocities_);
  std::string problem;
  for (const auto& part : transfer_.parts()) {
    auto& surface = part.body->surface;
    const std::size_t n_vertices = part.size();
    by_flow_.assign(n_vertices, Vec3{});
    for (std::size_t n = 0; n < n_vertices; ++n) {
      if (surface.is_pinned(n)) {
        surface.velocities[n] = {};
        continue;
      }
      const double fluid = layer() * transfer_.areas()[part.begin + n], share = fluid / (surface.masses[n] + fluid);
      const Vec3 before = flow_before_[part.begin + n];
      surface.velocities[n] += share * (before - surface.velocities[n]);
      by_flow_[n] = share * (velocities_[part.begin + n] - before);
    }
    if (part.kind->config.held) {
      for (auto* velocities : {&surface.velocities, &by_flow_}) {
        const Vec3 mean = mean_of(part, *velocities);
        for (Vec3& velocity : *velocities) velocity -= mean;
      }
    }
    try {
      advance(part, substep.alpha, dt);
    } catch (const RunError& error) {
      if (problem.empty()) problem = error.what();
    }
    if (part.kind->config.held) {
      const Vec3 mean = mean_of(part, surface.velocities);
      for (std::size_t n = 0; n < n_vertices; ++n) surface.velocities[n] -= mean;
    }
    for (std::size_t n = 0; n < n_vertices; ++n)
      velocities_[part.begin + n] = surface.velocities[n] - velocities_[part.begin + n];
  }
  elapsed_ += substep.alpha * dt;
  agree(grid_.ranks(), problem);
  transfer_.spread_increments(velocities_);
  transfer_.fields().gather();
  transfer_.fields().move_to(1, u, v, w);
  for (const auto& part : transfer_.parts()) {
    for (std::size_t i = part.begin; i < part.end; ++i) velocities_[i] *= layer() * transfer_.areas()[i];
    count_impulse(part, part.of(velocities_));
  }
}

}  // namespace pliant
