#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "flow/flow_solver.hpp"
#include "mesh/shapes/icosphere.hpp"
#include "transfer/direct_forcing.hpp"
#include "transfer/marker_refinement.hpp"

namespace pliant::test {

/// A fixed sphere in a periodic box through which the fluid is driven with mean speed 1 along x. Lengths are in cells.
struct SphereInFlow {
  int cells = 64;
  double diameter = 24;
  double reynolds = 50;
  double courant = 0.4;
  int iterations = 1;
};

/// What passes a shell that should be tight, over the speed of the flow.
struct Leak {
  int markers = 0;
  double rms_at_markers = 0;    ///< slip
  double rms = 0, largest = 0;  ///< slip anywhere on the surface
  double through = 0;           ///< half the integral of |u.n| over the surface, over the frontal area
  double inside = 0;            ///< mean |u| in the inner fluid, two cells and more from the surface
};

inline Grid make_grid(const SphereInFlow& c, const Communicator& ranks = Communicator()) {
  BoxConfig box;
  const double n = c.cells;
  box.size = {n, n, n};
  box.origin = {0, 0, 0};
  box.cells = {c.cells, c.cells, c.cells};
  return Grid(box, BoundaryConfig{}, ranks);
}

/// Off the symmetric places of the grid.
inline Vec3 center_of(const SphereInFlow& c) { return Vec3{0.5, 0.5, 0.5} * c.cells + Vec3{0.23, -0.31, 0.17}; }

inline FlowSolver make_solver(const SphereInFlow& c, const Grid& grid) {
  FlowParameters parameters;
  parameters.viscosity = c.diameter / c.reynolds;
  parameters.forcing.bulk_velocity = ForcingConfig::BulkVelocity{Axis::x, 1.0};
  FlowSolver solver(grid, parameters);
  InitialConfig initial;
  initial.flow = InitialFlow::uniform;
  initial.velocity = {1, 0.2, 0.3};
  set_initial_flow(solver, initial);
  return solver;
}

/// A step with markers that force the flow.
inline void advance(FlowSolver& solver, DirectForcing& forcing, double step) {
  solver.advance(step, [&](const Substep& s, double dt, View<FaceX> u, View<FaceY> v, View<FaceZ> w) {
    forcing.apply(s, dt, u, v, w);
  });
}

/// Whole velocities of the flow at points of a surface, on every rank.
inline std::vector<Vec3> velocities_at(const FlowSolver& solver, const std::vector<Vec3>& points) {
  DirectForcing reader(solver.grid(), 1.0);
  reader.place(points, std::vector<double>(points.size(), 1.0), std::vector<Vec3>(points.size()));
  std::vector<Vec3> velocities(points.size());
  const auto& flow = solver.state();
  reader.add_velocities(flow.u.view(), flow.v.view(), flow.w.view(), velocities);
  std::vector<double> numbers;
  for (Vec3 u : velocities) numbers.insert(numbers.end(), {u.x, u.y, u.z});
  if (!numbers.empty()) solver.grid().ranks().sum(numbers);
  for (std::size_t i = 0; i < velocities.size(); ++i)
    velocities[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
  return velocities;
}

inline double speed_inside(const FlowSolver& solver, Vec3 center, double radius) {
  const Grid& grid = solver.grid();
  const auto& flow = solver.state();
  const auto u = flow.u.view();
  const auto v = flow.v.view();
  const auto w = flow.w.view();
  double sums[2] = {};
  for (int k = 0; k < grid.nz(); ++k)
    for (int j = 0; j < grid.ny(); ++j)
      for (int i = 0; i < grid.nx(); ++i) {
        const Vec3 x{grid.x_center(i), grid.y_center(j), grid.z_center()[k]};
        if (norm(x - center) > radius) continue;
        sums[0] +=
            norm(Vec3{u(i, j, k) + u(i - 1, j, k), v(i, j, k) + v(i, j - 1, k), w(i, j, k) + w(i, j, k - 1)}) / 2;
        sums[1] += 1;
      }
  grid.ranks().sum(sums);
  return sums[0] / std::max(1.0, sums[1]);
}

/// Runs `steps` steps with a sphere of 20 frequency^2 faces, each split into parts^2 markers; parts = 0: by the rule.
inline Leak measure_leak(const SphereInFlow& c, int frequency, int parts, int steps) {
  const Grid grid = make_grid(c);
  auto solver = make_solver(c, grid);
  auto surface = make_icosphere(frequency, c.diameter / 2);
  for (Vec3& x : surface.positions) x += center_of(c);
  const std::vector<Vec3> rest(surface.positions.size());
  const auto layout = parts == 0
                          ? MarkerLayout(surface.mesh, refinement_for(surface.mesh, surface.positions, grid.dx()))
                          : MarkerLayout(surface.mesh, parts);
  MarkerSet markers, points;
  layout.place(surface.positions, rest, markers);
  // Many times finer than the grid: what happens between the markers shows.
  MarkerLayout(surface.mesh, std::max(3, 64 / frequency)).place(surface.positions, rest, points);

  DirectForcing forcing(grid, 1.0, c.iterations);
  forcing.place(markers.positions, markers.areas, markers.velocities);
  for (int n = 0; n < steps; ++n) advance(solver, forcing, c.courant);

  Leak leak;
  leak.markers = layout.n_markers();
  const auto& flow = solver.state();
  leak.rms_at_markers = forcing.rms_slip(flow.u.view(), flow.v.view(), flow.w.view());
  const auto velocities = velocities_at(solver, points.positions);
  double area = 0, squares = 0, through = 0;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    const double speed = norm(velocities[i]);
    area += points.areas[i];
    squares += points.areas[i] * speed * speed;
    leak.largest = std::max(leak.largest, speed);
    through += points.areas[i] * std::abs(dot(velocities[i], points.normals[i])) / 2;
  }
  leak.rms = std::sqrt(squares / area);
  leak.through = through / (M_PI * c.diameter * c.diameter / 4);
  leak.inside = speed_inside(solver, center_of(c), c.diameter / 2 - 2);
  return leak;
}

}  // namespace pliant::test
