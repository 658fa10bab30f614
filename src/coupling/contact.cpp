#include "coupling/contact.hpp"

#include <algorithm>

#include "mesh/geometry.hpp"
#include "transfer/point_router.hpp"

namespace pliant {
namespace {

RepulsionSide side_of(const BoundarySpec& spec) {
  if (std::holds_alternative<PeriodicSide>(spec)) return RepulsionSide::periodic;
  const bool passes = std::holds_alternative<InflowSide>(spec) || std::holds_alternative<OutflowSide>(spec);
  return passes ? RepulsionSide::open : RepulsionSide::wall;
}

}  // namespace

Contact::Contact(const Grid& grid, const CaseConfig& config)
    : grid_(grid),
      repulsion_{config.repulsion.strength, config.repulsion.range},
      law_{config.repulsion.range, config.repulsion.strength, config.repulsion.with_itself},
      has_deformable_(std::any_of(config.bodies.begin(), config.bodies.end(),
                                  [](const BodyConfig& b) { return b.motion == MotionKind::deformable; })),
      near_(grid, config.repulsion.range) {
  box_.origin = grid.origin();
  box_.size = grid.size();
  std::transform(config.boundary.begin(), config.boundary.end(), box_.sides.begin(), side_of);
}

void Contact::find(Bodies& bodies) const {
  std::vector<Vec3> positions;
  std::vector<double> numbers;  // area and body of every vertex
  for (const Body& body : bodies.own()) {
    if (!bodies.kind_of(body).has_pose() || !bodies.touches_others(body)) continue;
    const auto areas = vertex_areas(body.surface.mesh, body.surface.positions);
    for (std::size_t v = 0; v < areas.size(); ++v) {
      positions.push_back(body.surface.positions[v]);
      numbers.push_back(areas[v]);
      numbers.push_back(static_cast<double>(body.id));
    }
  }
  PointRouter router(grid_);
  router.route(positions, repulsion_.range);
  std::vector<double> held_numbers;
  router.send(numbers, 2, held_numbers);

  const auto held = router.held();
  const Slab slab = grid_.slab();
  std::vector<SurfacePoint> points;
  std::vector<std::size_t> order;
  std::size_t n_mine = 0;
  for (const bool mine : {true, false}) {
    for (std::size_t n = 0; n < held.size(); ++n) {
      const int plane = grid_.plane_of_height(held[n].z);
      if ((plane >= slab.begin && plane < slab.begin + slab.count) != mine) continue;
      points.push_back({held[n], held_numbers[2 * n], static_cast<int>(held_numbers[2 * n + 1])});
      order.push_back(n);
    }
    if (mine) n_mine = points.size();
  }
  std::vector<Vec3> found(n_mine), held_forces(held.size()), forces(positions.size());
  add_repulsion(points, n_mine, box_, repulsion_, found);
  for (std::size_t n = 0; n < n_mine; ++n) held_forces[order[n]] = found[n];
  router.collect(held_forces, forces);

  std::size_t at = 0;
  for (Body& body : bodies.own()) {
    if (!bodies.kind_of(body).has_pose() || !bodies.touches_others(body)) continue;
    const std::size_t n = body.surface.positions.size();
    body.loads.contact =
        body.loads.pressed + total_load(body.surface.positions, std::span(forces).subspan(at, n), body.pose.center);
    at += n;
  }
}

void Contact::begin(const Bodies& bodies, double step, PosedBodies posed) {
  if (!is_wanted() || !has_deformable_) return;
  auto obstacles = near_.find(bodies, step, posed);
  std::erase_if(contacts_, [&](const auto& entry) { return bodies.find(entry.first) == nullptr; });
  for (std::size_t b = 0; b < obstacles.size(); ++b) {
    const Body& body = bodies.own()[b];
    if (bodies.kind_of(body).has_pose() || !bodies.touches_others(body)) continue;
    contacts_.try_emplace(body.id, law_, box_).first->second.begin(body.surface, std::move(obstacles[b]), step);
  }
}

SurfaceContact* Contact::of(const Body& body) {
  const auto found = contacts_.find(body.id);
  return found == contacts_.end() ? nullptr : &found->second;
}

void Contact::end(Bodies& bodies, double step, ContactPass pass) {
  if (!is_wanted() || !has_deformable_) return;
  std::vector<std::span<const Vec3>> on_obstacles;
  for (const Body& body : bodies.own()) {
    const auto* contact = of(body);
    on_obstacles.push_back(contact != nullptr ? contact->impulses_on_obstacles() : std::span<const Vec3>{});
  }
  const auto told = near_.bring_back(bodies, on_obstacles);
  for (std::size_t b = 0; b < told.size(); ++b) {
    Body& body = bodies.own()[b];
    auto& surface = body.surface;
    if (bodies.kind_of(body).has_pose()) {
      auto pressed = total_load(surface.positions, told[b], body.pose.center);
      pressed.force *= 1 / step;
      pressed.torque *= 1 / step;
      body.loads.pressed = pass == ContactPass::second ? body.loads.pressed + pressed : pressed;
      if (pass != ContactPass::first) body.met = body.pose;
      continue;
    }
    // What others say they did to it, against what it took itself: each side gives way by half, as a whole. Vertex by
    // vertex the two differ by what is fast in either body, which must not drive the other.
    const auto* contact = of(body);
    if (contact == nullptr) continue;
    const auto taken = contact->impulses_of_yielding();
    const auto masses = contact->masses();
    const auto resistances = contact->resistances();
    Vec3 missing;
    double inertia = 0;
    for (std::size_t v = 0; v < taken.size(); ++v) {
      if (surface.is_pinned(v)) continue;
      missing += 0.5 * (told[b][v] - taken[v]);
      inertia += masses[v] + step * resistances[v];
    }
    const bool has_own_velocities =
        bodies.kind_of(body).coupling == CouplingKind::strong && !body.mass_velocities.empty();
    for (std::size_t v = 0; v < taken.size() && inertia > 0; ++v) {
      if (surface.is_pinned(v)) continue;
      surface.velocities[v] += missing / inertia;
      if (has_own_velocities) body.mass_velocities[v] += missing / inertia;
    }
  }
}

}  // namespace pliant
