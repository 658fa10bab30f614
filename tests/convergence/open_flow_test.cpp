#include <gtest/gtest.h>

#include "convergence/leaving_vortex.hpp"

namespace pliant::test {
namespace {

/// Inflow at one side of a direction and outflow at the other; `others` on the rest.
BoundaryConfig through(int direction, double speed, const BoundarySpec& others, InflowProfile profile, double ramp = 0) {
  BoundaryConfig sides;
  sides.fill(others);
  InflowSide inflow;
  inflow.velocity[direction] = speed;
  inflow.profile = profile;
  inflow.ramp = ramp;
  const std::size_t low = static_cast<std::size_t>(2 * direction);
  sides[speed > 0 ? low : low + 1] = inflow;
  sides[speed > 0 ? low + 1 : low] = OutflowSide{};
  return sides;
}

Vec3 along(int direction, double value) {
  Vec3 v;
  v[direction] = value;
  return v;
}

TEST(OpenFlow, UniformFlowPassesUnchangedInEveryDirection) {
  for (const BoundarySpec& others : {BoundarySpec{PeriodicSide{}}, BoundarySpec{FreeSlipSide{}}})
    for (int direction = 0; direction < 3; ++direction)
      for (double speed : {1.0, -0.7})
        for (ViscousMode mode : viscous_modes) {
          const auto sides = through(direction, speed, others, InflowProfile::uniform);
          const Grid grid = make_grid({10, 9, 8}, {1, 1.2, 0.9}, sides, {StretchingLaw::tanh, 1.0});
          FlowSolver solver = make_solver(grid, sides, 0.01, mode);
          InitialConfig initial;
          initial.flow = InitialFlow::uniform;
          initial.velocity = along(direction, speed);
          set_initial_flow(solver, initial);
          for (int n = 0; n < 10; ++n) solver.advance(0.01);
          EXPECT_LT(largest_error(solver, [&](Vec3) { return along(direction, speed); }), 1e-13)
              << "direction " << direction << " speed " << speed << " mode " << static_cast<int>(mode);
        }
}

// Disturbed flow, ramped and profiled inflow, several outflows: what comes in goes out, at every step, to round-off.
TEST(OpenFlow, MassIsBalancedToRoundOff) {
  for (int direction = 0; direction < 3; ++direction)
    for (ViscousMode mode : viscous_modes) {
      auto sides = through(direction, 1.0, WallSide{}, InflowProfile::parabolic, 0.05);
      sides[static_cast<std::size_t>(2 * ((direction + 1) % 3) + 1)] = OutflowSide{};
      const Grid grid = make_grid({12, 10, 14}, {1, 1, 1}, sides, {StretchingLaw::tanh, 1.0});
      FlowSolver solver = make_solver(grid, sides, 0.005, mode);
      InitialConfig initial;
      initial.flow = InitialFlow::perturbed;
      initial.amplitude = 0.3;
      set_initial_flow(solver, initial);
      EXPECT_LT(solver.largest_divergence(), 1e-12);
      for (int n = 0; n < 10; ++n) {
        solver.advance(0.01);
        EXPECT_LT(std::abs(solver.net_outward_flux()), 1e-15);
        EXPECT_LT(solver.largest_divergence(), 1e-12) << "direction " << direction;
      }
      EXPECT_LT(solver.kinetic_energy(), 5.0);
    }
}

// A parabola that comes in goes through a channel as a parabola.
TEST(OpenFlow, PoiseuilleThroughAChannelConvergesAtSecondOrder) {
  const auto error = [](int direction, int n) {
    const int normal = (direction + 2) % 3;
    auto sides = through(direction, 1.0, PeriodicSide{}, InflowProfile::parabolic);
    sides[static_cast<std::size_t>(2 * normal)] = sides[static_cast<std::size_t>(2 * normal + 1)] = WallSide{};
    std::array<int, 3> cells{2, 2, 2};
    cells[static_cast<std::size_t>(direction)] = cells[static_cast<std::size_t>(normal)] = n;
    const Grid grid = make_grid(cells, {1, 1, 1}, sides);
    FlowSolver solver = make_solver(grid, sides, 0.1, ViscousMode::implicit);
    InitialConfig initial;
    initial.flow = InitialFlow::poiseuille;
    initial.direction = static_cast<Axis>(direction);
    initial.normal = static_cast<Axis>(normal);
    set_initial_flow(solver, initial);
    run(solver, 4.0, 16 * n);
    return largest_error(solver, [&](Vec3 p) { return along(direction, 4 * p[normal] * (1 - p[normal])); });
  };
  for (int direction = 0; direction < 3; ++direction) {
    const double coarse = error(direction, 16), fine = error(direction, 32);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.3) << "direction " << direction << " " << coarse << " " << fine;
  }
}

// The implicit modes must let the increments of the sides into their solves: with a ramp they agree with the explicit
// mode as the step falls.
TEST(OpenFlow, ViscousModesAgreeWithARampAsTheStepFalls) {
  for (int direction = 0; direction < 3; ++direction) {
    auto sides = through(direction, 1.0, WallSide{}, InflowProfile::parabolic, 0.4);
    const Grid grid = make_grid({10, 10, 10}, {1, 1, 1}, sides);
    const auto solution = [&](ViscousMode mode, int steps) {
      FlowSolver solver = make_solver(grid, sides, 0.05, mode);
      run(solver, 0.3, steps);
      return velocities_of(solver);
    };
    const auto exact = solution(ViscousMode::explicit_rk3, 160);
    const auto distance = [&](ViscousMode mode, int steps) {
      return root_mean_square_difference(solution(mode, steps), exact);
    };
    for (ViscousMode mode : {ViscousMode::implicit_z, ViscousMode::implicit})
      EXPECT_LT(distance(mode, 40), 0.4 * distance(mode, 10)) << "direction " << direction;
  }
}

// The centre starts half a length before the way out: at t = 0.5 it is just passing, at 1.2 it is gone.
TEST(OpenFlow, AVortexLeavesWithoutVisibleReflection) {
  const LeavingVortex vortex{Axis::x, through(0, 1.0, FreeSlipSide{}, InflowProfile::uniform)};
  for (double time : {0.5, 1.2}) EXPECT_LT(vortex.largest_reflection(time), 0.01 * vortex.strength) << "t = " << time;
}

}  // namespace
}  // namespace pliant::test
