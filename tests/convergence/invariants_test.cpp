#include <gtest/gtest.h>

#include <cstring>
#include <numbers>

#include "convergence/flow_fixture.hpp"

namespace pliant::test {
namespace {

constexpr ViscousMode modes[] = {ViscousMode::explicit_rk3, ViscousMode::implicit_z, ViscousMode::implicit};

InitialConfig perturbed() {
  InitialConfig initial;
  initial.flow = InitialFlow::perturbed;
  initial.velocity = {0.5, -0.2, 0.1};
  initial.amplitude = 1.0;
  initial.seed = 7;
  return initial;
}

// Every pair of sides in every direction, moving walls included.
std::vector<BoundaryConfig> all_boxes() {
  std::vector<BoundaryConfig> boxes;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 3; ++z) {
        BoundaryConfig sides;
        const int kinds[3] = {x, y, z};
        for (int d = 0; d < 3; ++d)
          for (int s = 0; s < 2; ++s) {
            Vec3 velocity{0.3, -0.2, 0.4};
            velocity[d] = 0;
            auto& side = sides[static_cast<std::size_t>(2 * d + s)];
            if (kinds[d] == 1) side = WallSide{s == 0 ? velocity : -velocity};
            if (kinds[d] == 2) side = s == 0 ? BoundarySpec{FreeSlipSide{}} : BoundarySpec{WallSide{velocity}};
          }
        boxes.push_back(sides);
      }
  return boxes;
}

TEST(Invariants, DivergenceIsAtRoundOffAfterEveryStepInEveryBox) {
  for (const auto& sides : all_boxes())
    for (ViscousMode mode : modes) {
      const Grid grid = make_grid({12, 9, 14}, {1, 1.3, 0.8}, sides, {StretchingLaw::tanh, 1.0});
      FlowSolver solver = make_solver(grid, sides, 0.01, mode);
      set_initial_flow(solver, perturbed());
      for (int n = 0; n < 5; ++n) {
        solver.advance(0.01);
        EXPECT_LT(solver.largest_divergence(), 3e-13);
      }
      EXPECT_LT(solver.kinetic_energy(), 10.0);
    }
}

// Without viscosity the only change of energy is that of the time integrator, whose order shows when the step is
// halved.
TEST(Invariants, AdvectionKeepsKineticEnergyToTheOrderOfTheTimeIntegrator) {
  const auto drift = [](int steps, StretchingLaw law) {
    BoundaryConfig sides;
    if (law == StretchingLaw::tanh) sides[4] = sides[5] = FreeSlipSide{};
    const Grid grid = make_grid({16, 16, 16}, {1, 1, 1}, sides, {law, 1.0});
    FlowSolver solver = make_solver(grid, sides, 0.0, ViscousMode::explicit_rk3);
    set_initial_flow(solver, perturbed());
    const double before = solver.kinetic_energy();
    run(solver, 0.2, steps);
    return std::abs(solver.kinetic_energy() / before - 1);
  };
  for (StretchingLaw law : {StretchingLaw::uniform, StretchingLaw::tanh}) {
    const double coarse = drift(40, law), fine = drift(80, law);
    EXPECT_LT(coarse, 1e-3);
    EXPECT_GT(std::log2(coarse / fine), 1.9) << "stretching " << static_cast<int>(law) << " " << coarse << " " << fine;
  }
}

TEST(Invariants, ViscousModesAgreeAsTheStepFalls) {
  const auto sides = walls_along(2, {-0.5, 0, 0}, {0.5, 0.2, 0});
  const Grid grid = make_grid({12, 12, 12}, {1, 1, 1}, sides, {StretchingLaw::tanh, 1.0});
  const auto distance = [&](ViscousMode a, ViscousMode b, int steps) {
    FlowSolver first = make_solver(grid, sides, 0.02, a), second = make_solver(grid, sides, 0.02, b);
    for (FlowSolver* solver : {&first, &second}) {
      set_initial_flow(*solver, perturbed());
      run(*solver, 0.1, steps);
    }
    double sum = 0;
    const auto u = first.state().u.view();
    const auto v = second.state().u.view();
    for (int k = 0; k < grid.nz(); ++k)
      for (int j = 0; j < grid.ny(); ++j)
        for (int i = 0; i < grid.nx(); ++i) sum += std::pow(u(i, j, k) - v(i, j, k), 2);
    return std::sqrt(grid.ranks().sum(sum) / (12.0 * 12 * 12));
  };
  for (ViscousMode mode : {ViscousMode::implicit_z, ViscousMode::implicit}) {
    const double coarse = distance(ViscousMode::explicit_rk3, mode, 10);
    const double fine = distance(ViscousMode::explicit_rk3, mode, 40);
    EXPECT_LT(fine, 0.25 * coarse);
    EXPECT_LT(fine, 1e-3);
  }
}

TEST(Invariants, EqualRunsGiveTheSameBits) {
  const auto sides = walls_along(2);
  const Grid grid = make_grid({15, 12, 10}, {1, 1, 1}, sides);
  const auto result = [&] {
    FlowSolver solver = make_solver(grid, sides, 0.01, ViscousMode::implicit);
    set_initial_flow(solver, perturbed());
    run(solver, 0.1, 10);
    std::vector<double> values;
    for_each_velocity(solver, [&](int, int, int, int, double value) { values.push_back(value); });
    return values;
  };
  const auto first = result(), second = result();
  EXPECT_EQ(0, std::memcmp(first.data(), second.data(), first.size() * sizeof(double)));
}

}  // namespace
}  // namespace pliant::test
