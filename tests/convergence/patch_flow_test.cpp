#include <gtest/gtest.h>

#include <numbers>

#include "convergence/leaving_vortex.hpp"

namespace pliant::test {
namespace {

using std::numbers::pi;

PatchConfig disc(std::array<double, 2> center, double radius, std::string rate) {
  PatchConfig p;
  p.name = rate.empty() ? "out" : "in";
  p.center = center;
  p.radius = radius;
  p.flow_rate = std::move(rate);
  p.balance = p.flow_rate.empty();
  return p;
}

PatchConfig whole_side(std::string rate, std::array<double, 2> center, std::array<double, 2> size,
                       PatchProfile profile = PatchProfile::uniform) {
  auto p = disc(center, 1, std::move(rate));
  p.radius.reset();
  p.shape = PatchShape::rectangle;
  p.size = size;
  p.profile = profile;
  return p;
}

/// Walls in x, periodic in y: a channel along z from a patch to the one that balances it.
BoundaryConfig channel(const std::string& rate, PatchProfile profile) {
  BoundaryConfig sides = walls_along(0);
  sides[4] = WallSide{{}, {whole_side(rate, {0.5, 0.5}, {1, 1}, profile)}};
  sides[5] = WallSide{{}, {whole_side("", {0.5, 0.5}, {1, 1})}};
  return sides;
}

Vec3 poiseuille(Vec3 p, double mean) { return {0, 0, 6 * mean * p.x * (1 - p.x)}; }

TEST(PatchFlow, PoiseuilleFromPatchToPatchConvergesAtSecondOrder) {
  const auto sides = channel("2/3", PatchProfile::parabolic);
  const auto error = [&](int n) {
    const Grid grid = make_grid({n, 2, n}, {1, 1, 1}, sides);
    FlowSolver solver = make_solver(grid, sides, 0.1, ViscousMode::implicit);
    set_velocity(solver, [](Vec3 p) { return poiseuille(p, 2.0 / 3); });
    solver.project_initial();
    run(solver, 4.0, 16 * n);
    return largest_error(solver, [](Vec3 p) { return poiseuille(p, 2.0 / 3); });
  };
  const double coarse = error(16), fine = error(32);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.3) << coarse << " " << fine;
}

// A plug becomes a parabola on its way, whichever patch it enters through. At Re = 10 the entrance is some 0.6 heights
// long (Durst et al., J. Fluids Eng. 127 (2005) 1154), the middle is 2 from either end.
TEST(PatchFlow, APlugBecomesAParabolaFromEitherPatch) {
  for (double mean : {1.0, -1.0}) {
    const auto sides = channel(mean > 0 ? "1" : "-1", PatchProfile::uniform);
    const Grid grid = make_grid({24, 1, 64}, {1, 1, 4}, sides);
    FlowSolver solver = make_solver(grid, sides, 0.1, ViscousMode::implicit);
    run(solver, 8.0, 800);
    double worst = 0;
    for_each_velocity(solver, [&](int c, int i, int j, int k, double value) {
      const Vec3 at = position_of(grid, c, i, j, k);
      if (std::abs(at.z - 2) < 0.1) worst = std::max(worst, std::abs(value - poiseuille(at, mean)[c]));
    });
    EXPECT_LT(worst, 0.01) << mean;
  }
}

// Increments of the patches must reach the implicit solves, tangential ones of the balance patch too.
TEST(PatchFlow, ViscousModesAgreeAsTheStepFalls) {
  BoundaryConfig sides;
  sides.fill(WallSide{});
  sides[4] = WallSide{{0.5, 0.2, 0}, {disc({0.3, 0.6}, 0.25, "0.3*sin(8*t)")}};
  sides[5] = WallSide{{-0.3, 0, 0}, {disc({0.6, 0.5}, 0.3, "")}};
  const Grid grid = make_grid({12, 12, 10}, {1, 1, 1}, sides, {StretchingLaw::tanh, 0.8});
  const auto solution = [&](ViscousMode mode, int steps) {
    FlowSolver solver = make_solver(grid, sides, 0.05, mode);
    run(solver, 0.3, steps);
    return velocities_of(solver);
  };
  const auto exact = solution(ViscousMode::explicit_rk3, 240);
  const auto distance = [&](ViscousMode mode, int steps) {
    return root_mean_square_difference(solution(mode, steps), exact);
  };
  for (ViscousMode mode : {ViscousMode::implicit_z, ViscousMode::implicit})
    EXPECT_LT(distance(mode, 40), 0.4 * distance(mode, 10)) << static_cast<int>(mode);
}

// In through a disc and out through a ring around it, one side, Re = 400: the jet turns at the bottom and comes back.
TEST(PatchFlow, AJetComesBackThroughTheRingAroundIt) {
  BoundaryConfig sides;
  sides.fill(WallSide{});
  auto in = disc({0, 0}, 0.25, "0.05*(1-exp(-4*t))");
  in.profile = PatchProfile::parabolic;
  auto out = disc({0, 0}, 0.85, "");
  out.shape = PatchShape::annulus;
  out.inner_radius = 0.5;
  sides[5] = WallSide{{}, {in, out}};
  BoxConfig box;
  box.size = {2, 2, 1.5};
  box.origin = {-1, -1, 0};
  box.cells = {24, 24, 18};
  box.stretching_z = {StretchingLaw::tanh, 1.0};
  const Grid grid(box, sides, Communicator());
  FlowSolver solver = make_solver(grid, sides, 0.0012, ViscousMode::implicit);
  double deepest = 0;
  for (int n = 0; n < 250; ++n) {
    solver.advance(0.04);
    ASSERT_LT(solver.largest_divergence(), 1e-11) << "step " << n;
    ASSERT_LT(std::abs(solver.net_outward_flux()), 1e-15);
  }
  const auto w = std::as_const(solver).state().w.view();
  double asymmetry = 0;
  for (int k = 0; k < grid.nz(); ++k)
    for (int j = 0; j < 24; ++j)
      for (int i = 0; i < 24; ++i) asymmetry = std::max(asymmetry, std::abs(w(i, j, k) - w(23 - i, j, k)));
  for (int j = 11; j < 13; ++j)
    for (int i = 11; i < 13; ++i) deepest = std::min(deepest, w(i, j, 4));
  EXPECT_LT(asymmetry, 1e-9) << "round-off, grown by the shear of the jet";
  EXPECT_LT(deepest, -0.05) << "the jet has come near the bottom";
  const double inlet = 2 * 0.05 / (pi * 0.25 * 0.25);
  EXPECT_LT(solver.kinetic_energy(), 0.5 * inlet * inlet);
}

// A tank that breathes through its balance patch, Re = 1000: what left comes in again, and nothing piles up.
TEST(PatchFlow, ABreathingTankStaysBounded) {
  BoundaryConfig sides;
  sides.fill(WallSide{});
  auto tank = disc({0, 0}, 0.6, "");
  tank.shape = PatchShape::outside;
  sides[5] = WallSide{{}, {disc({0.1, 0}, 0.4, "0.15*sin(2*pi*t)"), tank}};
  BoxConfig box;
  box.size = {2, 2, 1};
  box.origin = {-1, -1, 0};
  box.cells = {20, 20, 12};
  const Grid grid(box, sides, Communicator());
  FlowSolver solver = make_solver(grid, sides, 2.5e-4, ViscousMode::explicit_rk3);
  std::array<double, 12> peaks{};
  for (std::size_t period = 0; period < peaks.size(); ++period)
    for (int n = 0; n < 25; ++n) {
      solver.advance(0.04);
      peaks[period] = std::max(peaks[period], solver.kinetic_energy());
      ASSERT_LT(solver.largest_divergence(), 1e-11);
    }
  EXPECT_LT(peaks[11], 1.5 * peaks[5]) << peaks[5] << " " << peaks[8] << " " << peaks[11];
}

// Fluid at rest that is drawn through a hole moves without vorticity and stops with what draws it: only layers on the
// hole's own wall are left. Re = 320. (Were the velocity in the hole given, no slip included, a fifth of the energy
// would stay in a jet.)
TEST(PatchFlow, AHoleLeavesNoJetBehindAsItCloses) {
  BoundaryConfig sides;
  sides.fill(FreeSlipSide{});
  sides[4] = FreeSlipSide{{whole_side("", {0.5, 0.5}, {1, 1})}};
  sides[5] = WallSide{{}, {disc({0.5, 0.5}, 0.2, "t < 1 ? -0.15*sin(pi*t)^2 : 0")}};
  const Grid grid = make_grid({20, 20, 20}, {1, 1, 1}, sides);
  for (ViscousMode mode : viscous_modes) {
    FlowSolver solver = make_solver(grid, sides, 1.5e-3, mode);
    double peak = 0;
    for (int n = 0; n < 100; ++n) {
      solver.advance(0.01);
      peak = std::max(peak, solver.kinetic_energy());
    }
    EXPECT_LT(solver.kinetic_energy(), 0.05 * peak) << static_cast<int>(mode);
  }
}

// As AVortexLeavesWithoutVisibleReflection, through a patch.
TEST(PatchFlow, AVortexLeavesThroughTheBalancePatch) {
  BoundaryConfig sides;
  sides[0] = sides[1] = FreeSlipSide{};
  sides[4] = InflowSide{{0, 0, 1}};
  sides[5] = WallSide{{}, {whole_side("", {0.5, 0.5}, {1, 1})}};
  const LeavingVortex vortex{Axis::z, sides};
  for (double time : {0.5, 1.2}) EXPECT_LT(vortex.largest_reflection(time), 0.01 * vortex.strength) << "t = " << time;
}

TEST(PatchFlow, TellsTheTimeStepHowFastItWillBe) {
  BoundaryConfig sides;
  sides.fill(WallSide{});
  auto in = disc({0.5, 0.5}, 0.4, "0.3*sin(2*pi*t)");
  sides[4] = WallSide{{}, {in}};
  sides[5] = WallSide{{}, {disc({0.5, 0.5}, 0.3, "")}};
  const Grid grid = make_grid({40, 40, 16}, {1, 1, 1}, sides);
  const FlowSolver solver = make_solver(grid, sides, 0.01, ViscousMode::implicit);
  // The balance patch is the faster one. Its area on the grid is the disc's to 2 %.
  EXPECT_NEAR(solver.largest_side_rate(10.0), 0.3 / (pi * 0.09) * 16, 0.02 * 0.3 / (pi * 0.09) * 16);
  EXPECT_NEAR(solver.largest_side_rate(0.05), std::sin(0.1 * pi) * solver.largest_side_rate(10.0), 1e-3);
  sides[4] = InflowSide{{0, 0, 2}, InflowProfile::uniform, 0, "1-2*t"};
  EXPECT_NEAR(make_solver(grid, sides, 0.01, ViscousMode::implicit).largest_side_rate(0.1), 2 / (pi * 0.09) * 16,
              0.02 * 2 / (pi * 0.09) * 16);
}

}  // namespace
}  // namespace pliant::test
