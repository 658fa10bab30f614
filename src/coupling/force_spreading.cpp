#include "coupling/force_spreading.hpp"

#include <algorithm>
#include <limits>

#include "coupling/added_mass.hpp"
#include "mesh/geometry.hpp"
#include "structure/interface_mesh.hpp"

namespace pliant {
namespace {

constexpr double evening = 0.1;          // of the way to an even mesh, a substep
constexpr double with_added_mass = 1.5;  // of a drop as heavy as the fluid, over its own mass
constexpr double prompt_hold = 0.6, lasting_hold = 0.15;

bool has_mass(const DeformableBody& body) {
  return std::any_of(body.masses.begin(), body.masses.end(), [](double m) { return m > 0; });
}

}  // namespace

ForceSpreading::ForceSpreading(const Grid& grid, const CaseConfig& config, Bodies& bodies, Contact& contact)
    : SoftBodies(grid, config, bodies, contact, CouplingKind::force_spreading),
      step_limit_(std::numeric_limits<double>::infinity()) {
  for (const auto& kind : bodies.kinds()) {
    if (kind.has_pose() || kind.coupling != CouplingKind::force_spreading) continue;
    step_limit_ = std::min(step_limit_, force_spreading_limit(kind));
    has_inertia_ |=
        has_mass(kind.prototype) || !kind.prototype.pinned.empty() || (kind.config.held && !kind.is_closed());
  }
}

Vec3 ForceSpreading::common_velocity(const VertexTransfer::Part& part, std::span<const Vec3> velocities) const {
  const auto& surface = part.body->surface;
  return part.kind->is_closed() ? centroid_velocity(surface.mesh, surface.positions, velocities)
                                : mean_of(part, velocities);
}

// A traction g.x along the normals is a body force g inside, but for a gradient, which the pressure takes. Spread along
// the surface, as a shift of all vertices is, it would drive a liquid interface around the body. g follows the velocity
// c that the centroid is left with: a part that lasts, and one against c that takes away most of it within the substep.
void ForceSpreading::add_hold(const VertexTransfer::Part& part, double time, std::span<Vec3> forces) const {
  const auto& surface = part.body->surface;
  const auto& memory = part.body->scheme;
  if (memory.empty()) return;
  const Vec3 lasting{memory[0], memory[1], memory[2]}, left{memory[3], memory[4], memory[5]};
  const Vec3 g = lasting - (prompt_hold * with_added_mass / time) * left;
  const Vec3 centre = mean_position(surface.positions);
  const auto gradient = volume_gradient(surface.mesh, surface.positions);
  for (std::size_t v = 0; v < forces.size(); ++v)
    forces[v] += density_ * dot(g, surface.positions[v] - centre) * gradient[v];
}

void ForceSpreading::adjust_hold(const VertexTransfer::Part& part, double dt, Vec3 left) const {
  auto& memory = part.body->scheme;
  memory.resize(6);
  for (int d = 0; d < 3; ++d) {
    memory[d] -= lasting_hold * with_added_mass / dt * left[d];
    memory[3 + d] = left[d];
  }
}

// Surfaces less than a spacing apart share the nodes that opposite forces of contact are spread to, where they cancel:
// the flow alone cannot keep them apart. What is left of their approach is taken from the vertices themselves.
void ForceSpreading::keep_apart(const VertexTransfer::Part& part, double time) {
  auto* contact = contact_.of(*part.body);
  if (contact == nullptr) return;
  auto& surface = part.body->surface;
  auto& in_contact = part.body->in_contact;
  const auto masses = layered_masses(part);
  const auto mobilities = mobilities_of(surface, masses, time);
  std::vector<Vec3> pushes(surface.positions.size());
  contact->add_forces({surface.positions, surface.velocities, mobilities, elapsed_, time, masses}, pushes);
  in_contact.assign(pushes.size(), 0);
  for (std::size_t v = 0; v < pushes.size(); ++v) {
    if (pushes[v] == Vec3{}) continue;
    surface.velocities[v] += mobilities[v] * pushes[v];
    in_contact[v] = 1;
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
  for (const auto& part : transfer_.parts()) {
    if (part.kind->separates()) remove_mean_pressure(part, part.of(forces_));
    if (part.kind->is_closed() && part.kind->config.held) add_hold(part, time, part.of(forces_));
  }
  transfer_.spread_forces(forces_);
  transfer_.fields().hand_over();
  for (Vec3& f : forces_) f *= time;
  for (const auto& part : transfer_.parts()) count_impulse(part, part.of(forces_));
}

void ForceSpreading::predicted(const Substep&, double, View<FaceX> u, View<FaceY> v, View<FaceZ> w) {
  transfer_.find_velocities(u, v, w, velocities_);
  auto& increments = forces_;
  for (const auto& part : transfer_.parts()) {
    Body& body = *part.body;
    const auto& surface = body.surface;
    const bool shifts = part.kind->config.held && !part.kind->is_closed();
    const Vec3 shift = shifts ? common_velocity(part, part.of(velocities_)) : Vec3{};
    for (std::size_t n = 0; n < part.size(); ++n) {
      const std::size_t i = part.begin + n;
      const Vec3 before = velocities_[i];
      const double fluid = layer() * transfer_.areas()[i], mass = surface.masses[n];
      Vec3& own = body.mass_velocities[n];
      own = surface.is_pinned(n) ? Vec3{} : (mass * own + fluid * (before - shift)) / (mass + fluid);
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
    const Vec3 mean = part.kind->config.held ? common_velocity(part, part.of(velocities_)) : Vec3{};
    if (part.kind->config.held && part.kind->is_closed()) adjust_hold(part, dt, mean);
    for (std::size_t v = 0; v < surface.velocities.size(); ++v)
      surface.velocities[v] = surface.is_pinned(v) ? Vec3{} : velocities_[part.begin + v] - mean;
    if (surface.is_interface) keep_normal_part(surface.mesh, surface.positions, surface.velocities);
    keep_apart(part, substep.alpha * dt);
  }
  drift(0.5 * substep.alpha * dt);
  for (const auto& part : transfer_.parts())
    if (auto& surface = part.body->surface; surface.is_interface) even_out(surface.mesh, surface.positions, evening);
}

}  // namespace pliant
