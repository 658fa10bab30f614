#include "coupling/force_spreading.hpp"

#include <algorithm>
#include <limits>

#include "mesh/geometry.hpp"
#include "structure/stable_time_step.hpp"

namespace pliant {
namespace {

constexpr double largest_alpha = 8.0 / 15;  // of a substep

bool has_mass(const DeformableBody& body) {
  return std::any_of(body.masses.begin(), body.masses.end(), [](double m) { return m > 0; });
}

}  // namespace

ForceSpreading::ForceSpreading(const Grid& grid, const CaseConfig& config, Bodies& bodies, Contact& contact)
    : SoftBodies(grid, config, bodies, contact, CouplingKind::force_spreading), step_limit_(std::numeric_limits<double>::infinity()) {
  for (const auto& kind : bodies.kinds()) {
    if (kind.has_pose() || kind.coupling != CouplingKind::force_spreading) continue;
    step_limit_ = std::min(step_limit_, substep_safety * kind.layered_limit / largest_alpha);
    has_inertia_ |= has_mass(kind.prototype) || !kind.prototype.pinned.empty() || kind.config.held;
  }
}

void ForceSpreading::drift(double time) {
  for (const auto& part : transfer_.parts()) {
    auto& surface = part.body->surface;
    for (std::size_t v = 0; v < surface.positions.size(); ++v) surface.positions[v] += time * surface.velocities[v];
  }
}

void ForceSpreading::before(const Substep& substep, double dt) {
  const double time = substep.alpha * dt;
  for (Body& body : bodies_.own()) {
    const auto& kind = bodies_.kind_of(body);
    if (kind.has_pose() || kind.coupling != coupling_) continue;
    auto& surface = body.surface;
    for (std::size_t v = 0; v < surface.positions.size(); ++v)
      surface.positions[v] += 0.5 * time * surface.velocities[v];
  }
  place();
  if (substep.index == 0) begin_step();
  find_forces(forces_);
  for (const auto& part : transfer_.parts()) {
    auto* contact = contact_.of(*part.body);
    if (contact == nullptr) continue;
    const auto& surface = part.body->surface;
    const auto masses = layered_masses(part);
    contact->add_forces({surface.positions, surface.velocities, mobilities_of(surface, masses, time),
                         elapsed_ + 0.5 * time, time, masses},
                        part.of(forces_));
  }
  elapsed_ += time;
  // What holds a pinned vertex is not the flow.
  for (const auto& part : transfer_.parts())
    for (std::size_t v = 0; v < part.size(); ++v)
      if (part.body->surface.is_pinned(v)) forces_[part.begin + v] = {};
  transfer_.spread_forces(forces_);
  transfer_.fields().hand_over();
  for (Vec3& f : forces_) f *= time;
  for (const auto& part : transfer_.parts())
    count_impulse(part, part.of(forces_));
}

void ForceSpreading::predicted(const Substep&, double, View<FaceX> u, View<FaceY> v, View<FaceZ> w) {
  transfer_.find_velocities(u, v, w, velocities_);
  auto& increments = forces_;
  for (const auto& part : transfer_.parts()) {
    Body& body = *part.body;
    const auto& surface = body.surface;
    const Vec3 mean = part.kind->config.held ? mean_of(part, part.of(velocities_)) : Vec3{};
    for (std::size_t n = 0; n < part.size(); ++n) {
      const std::size_t i = part.begin + n;
      const Vec3 before = velocities_[i];
      const double fluid = layer() * transfer_.areas()[i], mass = surface.masses[n];
      const Vec3 held = before - mean;
      Vec3& own = body.mass_velocities[n];
      own = surface.is_pinned(n) ? Vec3{} : (mass * own + fluid * held) / (mass + fluid);
      increments[i] = own - before;
    }
  }
  transfer_.spread_increments(increments);
  transfer_.fields().gather();
  transfer_.fields().move_to(1, u, v, w);
  for (const auto& part : transfer_.parts()) {
    for (std::size_t i = part.begin; i < part.end; ++i) increments[i] *= layer() * transfer_.areas()[i];
    count_impulse(part, part.of(increments));
  }
}

void ForceSpreading::corrected(const Substep& substep, double dt, const FlowState& flow) {
  transfer_.find_velocities(flow.u.view(), flow.v.view(), flow.w.view(), velocities_);
  for (const auto& part : transfer_.parts()) {
    auto& surface = part.body->surface;
    const Vec3 mean = part.kind->config.held ? mean_of(part, part.of(velocities_)) : Vec3{};
    for (std::size_t v = 0; v < surface.velocities.size(); ++v)
      surface.velocities[v] = surface.is_pinned(v) ? Vec3{} : velocities_[part.begin + v] - mean;
  }
  drift(0.5 * substep.alpha * dt);
}

}  // namespace pliant
