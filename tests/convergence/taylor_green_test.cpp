#include <gtest/gtest.h>

#include <numbers>

#include "convergence/flow_fixture.hpp"

namespace pliant::test {
namespace {

constexpr double pi = std::numbers::pi;

/// The decaying vortex in the plane normal to an axis.
std::function<Vec3(Vec3)> vortex(int normal, double decay) {
  return [=](Vec3 p) {
    const int a = (normal + 1) % 3, b = (normal + 2) % 3;
    Vec3 u;
    u[a] = decay * std::cos(p[a]) * std::sin(p[b]);
    u[b] = -decay * std::sin(p[a]) * std::cos(p[b]);
    return u;
  };
}

double taylor_green_error(int normal, int n, ViscousMode mode) {
  std::array<int, 3> cells{n, n, n};
  cells[static_cast<std::size_t>(normal)] = 4;
  const auto sides = periodic_box();
  const Grid grid = make_grid(cells, {2 * pi, 2 * pi, 2 * pi}, sides);
  const double nu = 0.1, end = 0.5;
  FlowSolver solver = make_solver(grid, sides, nu, mode);
  InitialConfig initial;
  initial.flow = InitialFlow::taylor_green;
  initial.normal = static_cast<Axis>(normal);
  set_initial_flow(solver, initial);
  run(solver, end, n);
  return largest_error(solver, vortex(normal, std::exp(-2 * nu * end)));
}

TEST(TaylorGreen, SecondOrderInSpaceInEveryPlane) {
  for (int normal = 0; normal < 3; ++normal)
    for (ViscousMode mode : {ViscousMode::explicit_rk3, ViscousMode::implicit_z, ViscousMode::implicit}) {
      const double coarse = taylor_green_error(normal, 16, mode), fine = taylor_green_error(normal, 32, mode);
      EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1) << "normal " << normal << " mode " << static_cast<int>(mode);
    }
}

// Free-slip sides cut a Taylor-Green array along its symmetry planes; the same decay must hold, stretched z included.
double free_slip_error(int n, StretchingLaw law) {
  BoundaryConfig sides;
  sides.fill(FreeSlipSide{});
  const Grid grid = make_grid({n, 2, n}, {pi, 1, pi}, sides, {law, 1.0});
  const double nu = 0.1, end = 0.5;
  FlowSolver solver = make_solver(grid, sides, nu, ViscousMode::implicit);
  const auto exact = [](double decay) {
    return [decay](Vec3 p) {
      return Vec3{decay * std::sin(p.x) * std::cos(p.z), 0, -decay * std::cos(p.x) * std::sin(p.z)};
    };
  };
  set_velocity(solver, exact(1.0));
  solver.project_initial();
  run(solver, end, 2 * n);
  return largest_error(solver, exact(std::exp(-2 * nu * end)));
}

TEST(TaylorGreen, SecondOrderBetweenFreeSlipSides) {
  for (StretchingLaw law : {StretchingLaw::uniform, StretchingLaw::tanh}) {
    const double coarse = free_slip_error(24, law), fine = free_slip_error(48, law);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.15) << "stretching " << static_cast<int>(law);
  }
}

// Second order in time: the solution on one grid against a far smaller step on the same grid.
TEST(TaylorGreen, SecondOrderInTime) {
  for (ViscousMode mode : {ViscousMode::explicit_rk3, ViscousMode::implicit_z, ViscousMode::implicit}) {
    const auto sides = periodic_box();
    const Grid grid = make_grid({12, 12, 12}, {2 * pi, 2 * pi, 2 * pi}, sides);
    const auto solve = [&](int steps) {
      FlowSolver solver = make_solver(grid, sides, 0.05, mode);
      // Two vortices in different planes interact, so that advection, pressure and viscosity all count.
      set_velocity(solver, [](Vec3 p) { return vortex(0, 1.0)(p) + vortex(1, 0.7)(p) + Vec3{0.3, 0, 0}; });
      run(solver, 1.0, steps);
      return solver;
    };
    const FlowSolver reference = solve(640);
    const auto difference = [&](const FlowSolver& solver) {
      double sum = 0;
      const auto a = solver.state().u.view();
      const auto b = reference.state().u.view();
      for (int k = 0; k < grid.nz(); ++k)
        for (int j = 0; j < grid.ny(); ++j)
          for (int i = 0; i < grid.nx(); ++i) sum += std::pow(a(i, j, k) - b(i, j, k), 2);
      return std::sqrt(grid.ranks().sum(sum));
    };
    const double order = std::log2(difference(solve(20)) / difference(solve(40)));
    EXPECT_GT(order, 1.9) << "mode " << static_cast<int>(mode);
  }
}

}  // namespace
}  // namespace pliant::test
