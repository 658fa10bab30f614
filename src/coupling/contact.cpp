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
    : grid_(grid), repulsion_{config.repulsion.strength, config.repulsion.range} {
  box_.origin = grid.origin();
  box_.size = grid.size();
  std::transform(config.boundary.begin(), config.boundary.end(), box_.sides.begin(), side_of);
}

void Contact::find(Bodies& bodies) const {
  std::vector<Vec3> positions;
  std::vector<double> numbers;  // area and body of every vertex
  for (const Body& body : bodies.own()) {
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
    const std::size_t n = body.surface.positions.size();
    body.loads.contact = total_load(body.surface.positions, std::span(forces).subspan(at, n), body.pose.center);
    at += n;
  }
}

}  // namespace pliant
