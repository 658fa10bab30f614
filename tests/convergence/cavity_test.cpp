#include <gtest/gtest.h>

#include <algorithm>

#include "convergence/flow_fixture.hpp"

namespace pliant::test {
namespace {

struct Extremes {
  double u_min, w_max, w_min;
};

// Lid-driven cavity at Re = 100, walls in two directions, corners included: extremes on the centrelines, which lie on
// faces of the grid.
Extremes cavity(int n) {
  BoundaryConfig sides;
  sides[0] = sides[1] = sides[4] = WallSide{};
  sides[5] = WallSide{{1, 0, 0}};
  const Grid grid = make_grid({n, 1, n}, {1, 1.0 / n, 1}, sides);
  FlowSolver solver = make_solver(grid, sides, 0.01, ViscousMode::implicit);
  run(solver, 15.0, 20 * n);
  Extremes e{};
  for (int k = 0; k < n; ++k) {
    e.u_min = std::min(e.u_min, solver.state().u.view()(n / 2 - 1, 0, k));
    e.w_max = std::max(e.w_max, solver.state().w.view()(k, 0, n / 2 - 1));
    e.w_min = std::min(e.w_min, solver.state().w.view()(k, 0, n / 2 - 1));
  }
  return e;
}

// Spectral values of Botella and Peyret, Computers & Fluids 27 (1998) 421-433.
TEST(Cavity, ConvergesToTheSpectralExtremesAtSecondOrder) {
  constexpr Extremes exact{-0.2140424, 0.1795728, -0.2538030};
  const Extremes coarse = cavity(32), fine = cavity(64);
  const auto expect_order = [](double c, double f, double e) {
    EXPECT_NEAR(std::log2(std::abs(c - e) / std::abs(f - e)), 2.0, 0.3) << c << " " << f << " " << e;
  };
  expect_order(coarse.u_min, fine.u_min, exact.u_min);
  expect_order(coarse.w_max, fine.w_max, exact.w_max);
  expect_order(coarse.w_min, fine.w_min, exact.w_min);
}

}  // namespace
}  // namespace pliant::test
