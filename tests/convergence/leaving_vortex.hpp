#pragma once
#include "convergence/flow_fixture.hpp"

namespace pliant::test {

/// A vortex that is carried out of a unit box, along x or z, in its x-z plane; its largest swirl is `strength`.
struct LeavingVortex {
  static constexpr double core = 0.1, strength = 0.3;

  Axis along;
  BoundaryConfig sides;

  FlowSolver solve(double length, double end) const {
    const int direction = static_cast<int>(along);
    std::array<int, 3> cells{48, 1, 48};
    Vec3 size{1, 1, 1}, mean;
    cells[static_cast<std::size_t>(direction)] = static_cast<int>(48 * length);
    size[direction] = length;
    mean[direction] = 1;
    const Grid grid = make_grid(cells, size, sides);
    FlowSolver solver = make_solver(grid, sides, 1e-3, ViscousMode::explicit_rk3);
    set_velocity(solver, [&](Vec3 p) {
      const double x = p.x - 0.5, z = p.z - 0.5, r2 = (x * x + z * z) / (core * core);
      const double swirl = strength / core * std::exp(0.5 * (1 - r2));
      return mean + Vec3{swirl * z, 0, -swirl * x};
    });
    solver.project_initial();
    run(solver, end, static_cast<int>(200 * end));
    return solver;
  }

  /// Largest difference from the same flow in a box three times as long, from which the vortex does not leave.
  double largest_reflection(double time) const {
    const FlowSolver cut = solve(1.0, time), whole = solve(3.0, time);
    double worst = 0;
    for_each_velocity(cut, [&](int c, int i, int j, int k, double value) {
      if ((along == Axis::x ? i : k) > 36 || c == 1) return;  // the last quarter belongs to the way out
      const double reference = c == 0 ? whole.state().u.view()(i, j, k) : whole.state().w.view()(i, j, k);
      worst = std::max(worst, std::abs(value - reference));
    });
    return worst;
  }
};

}  // namespace pliant::test
