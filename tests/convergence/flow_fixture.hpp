#pragma once
#include <cmath>
#include <functional>
#include <vector>

#include "flow/flow_solver.hpp"

/// Small boxes and error norms shared by the flow tests.
namespace pliant::test {

inline constexpr ViscousMode viscous_modes[] = {ViscousMode::explicit_rk3, ViscousMode::implicit_z,
                                                ViscousMode::implicit};

inline BoundaryConfig periodic_box() { return {}; }

inline BoundaryConfig walls_along(int normal, Vec3 low = {}, Vec3 high = {}) {
  BoundaryConfig sides;
  sides[static_cast<std::size_t>(2 * normal)] = WallSide{low};
  sides[static_cast<std::size_t>(2 * normal + 1)] = WallSide{high};
  return sides;
}

inline Grid make_grid(std::array<int, 3> cells, Vec3 size, const BoundaryConfig& sides,
                      StretchingConfig stretching = {}) {
  BoxConfig box;
  box.cells = cells;
  box.size = size;
  box.stretching_z = stretching;
  return Grid(box, sides, Communicator());
}

inline FlowSolver make_solver(const Grid& grid, const BoundaryConfig& sides, double nu, ViscousMode mode,
                              ForcingConfig forcing = {}) {
  FlowParameters parameters;
  parameters.viscosity = nu;
  parameters.viscous = mode;
  parameters.boundary = sides;
  parameters.forcing = forcing;
  return FlowSolver(grid, parameters);
}

/// Position of a velocity component's point.
inline Vec3 position_of(const Grid& grid, int component, int i, int j, int k) {
  return {component == 0 ? grid.x_face(i) : grid.x_center(i), component == 1 ? grid.y_face(j) : grid.y_center(j),
          component == 2 ? grid.z_face()[k] : grid.z_center()[k]};
}

/// Calls visit(component, i, j, k, value) for every interior velocity of this rank.
template <class Visit>
void for_each_velocity(const FlowSolver& solver, Visit&& visit) {
  const Grid& grid = solver.grid();
  const auto u = solver.state().u.view();
  const auto v = solver.state().v.view();
  const auto w = solver.state().w.view();
  for (int k = 0; k < grid.nz(); ++k)
    for (int j = 0; j < grid.ny(); ++j)
      for (int i = 0; i < grid.nx(); ++i) {
        visit(0, i, j, k, u(i, j, k));
        visit(1, i, j, k, v(i, j, k));
        visit(2, i, j, k, w(i, j, k));
      }
}

/// The interior velocities of this rank, in the order of for_each_velocity.
inline std::vector<double> velocities_of(const FlowSolver& solver) {
  std::vector<double> values;
  for_each_velocity(solver, [&](int, int, int, int, double value) { values.push_back(value); });
  return values;
}

/// Largest difference from an exact velocity field over all ranks.
inline double largest_error(const FlowSolver& solver, const std::function<Vec3(Vec3)>& exact) {
  double worst = 0;
  for_each_velocity(solver, [&](int c, int i, int j, int k, double value) {
    worst = std::max(worst, std::abs(value - exact(position_of(solver.grid(), c, i, j, k))[c]));
  });
  return solver.grid().ranks().max(worst);
}

/// Sets the velocity from a function of position.
inline void set_velocity(FlowSolver& solver, const std::function<Vec3(Vec3)>& velocity) {
  const Grid& grid = solver.grid();
  auto& s = solver.state();
  const auto u = s.u.view();
  const auto v = s.v.view();
  const auto w = s.w.view();
  for (int k = 0; k < grid.nz(); ++k)
    for (int j = 0; j < grid.ny(); ++j)
      for (int i = 0; i < grid.nx(); ++i) {
        u(i, j, k) = velocity(position_of(grid, 0, i, j, k)).x;
        v(i, j, k) = velocity(position_of(grid, 1, i, j, k)).y;
        w(i, j, k) = velocity(position_of(grid, 2, i, j, k)).z;
      }
  solver.fill_ghosts();
}

inline double root_mean_square_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

inline void run(FlowSolver& solver, double end, int steps) {
  for (int n = 0; n < steps; ++n) solver.advance(end / steps);
}

}  // namespace pliant::test
