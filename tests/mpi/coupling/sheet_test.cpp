#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "coupling/loose.hpp"
#include "mpi/coupling/small_cases.hpp"

// A periodic flow driven along one sheet and its periodic copies: plane Poiseuille flow between them.
namespace pliant {
namespace {

/// A box as high as the channel, of n cells, with the sheet `offset` spacings above the middle.
CaseConfig channel(int n, double offset) {
  const double h = 1.0 / n;
  CaseConfig config;
  config.box.size = {4 * h, 4 * h, 1};
  config.box.cells = {4, 4, n};
  config.fluid.density = 2;
  config.fluid.viscosity = 2;
  config.forcing.acceleration = {12, 0, 0};  // a mean velocity of 1
  config.immersed_boundary.forcing_iterations = 3;
  BodyConfig sheet;
  sheet.name = "sheet";
  sheet.surface = PlateSurface{{4 * h, 4 * h}, h};
  sheet.center = {2 * h, 2 * h, 0.5 + offset * h};
  sheet.motion = MotionKind::fixed;
  sheet.marker_retraction = 0;
  config.bodies = {sheet};
  return config;
}

/// The sheet along the diagonal of the box's section, driven across it and along it.
CaseConfig diagonal_channel(int n) {
  auto config = channel(n, 0);
  const double h = 1.0 / n, length = std::sqrt(2.0);
  config.box.size = {1, 4 * h, 1};
  config.box.cells = {n, 4, n};
  config.forcing.acceleration = {8, 12, -8};
  config.bodies[0].surface = PlateSurface{{length, 4 * h}, h};
  config.bodies[0].rotation = {{0, 1, 0}, 45};
  config.bodies[0].center = {0.5 + 0.3 * h, 2 * h, 0.5};
  return config;
}

/// Mean velocity at a time. The flow starts at rest; explicit, in steps of 0.1 h^2/nu.
Vec3 mean_velocity(const CaseConfig& config, double end, const Communicator& ranks = Communicator()) {
  const Grid grid(config.box, config.boundary, ranks);
  FlowParameters parameters;
  parameters.density = config.fluid.density;
  parameters.viscosity = config.fluid.viscosity / config.fluid.density;
  parameters.boundary = config.boundary;
  parameters.forcing = config.forcing;
  parameters.viscous = ViscousMode::explicit_rk3;
  Bodies bodies(config, grid);
  FlowSolver flow(grid, parameters);
  CoupledFlow coupled(config, flow, bodies, RunStart::anew);
  const int steps = static_cast<int>(std::ceil(end / (0.1 * grid.dx() * grid.dx() / parameters.viscosity)));
  for (int n = 1; n <= steps; ++n) advance_loose(coupled, n * end / steps, end / steps);
  std::array<double, 3> sums{};
  for (int k = 0; k < grid.nz(); ++k)
    for (int j = 0; j < grid.ny(); ++j)
      for (int i = 0; i < grid.nx(); ++i) {
        sums[0] += flow.state().u.view()(i, j, k);
        sums[1] += flow.state().v.view()(i, j, k);
        sums[2] += flow.state().w.view()(i, j, k);
      }
  grid.ranks().sum(sums);
  const double cells = static_cast<double>(config.box.cells[0]) * config.box.cells[1] * config.box.cells[2];
  return Vec3{sums[0], sums[1], sums[2]} / cells;
}

TEST(Sheet, IsThinToSecondOrder) {
  for (const double offset : {0.0, 0.25, 0.5}) {
    const double coarse = mean_velocity(channel(8, offset), 1.0).x - 1,
                 fine = mean_velocity(channel(16, offset), 1.0).x - 1;
    EXPECT_LT(std::abs(fine), 0.01) << offset;
    EXPECT_GT(std::abs(coarse), 3 * std::abs(fine)) << offset;
  }
}

TEST(Sheet, IsASpacingThickWithoutSlip) {
  // Between two planes of nodes the force holds both: m = n - 1 spacings are left, on which the parabola is exact.
  for (const int n : {8, 16}) {
    auto config = channel(n, 0);
    config.bodies[0].thin_sheet = false;
    config.immersed_boundary.forcing_iterations = 20;
    const double m = n - 1;
    EXPECT_NEAR(mean_velocity(config, 1.0).x, m * (m * m - 1) / (n * n * n), 1e-3) << n;
  }
}

TEST(Sheet, IsThinAcrossTheGridToATenthOfASpacing) {
  // Height 1/sqrt 2; means g H^2/(12 nu) across the section and along the sheet. Walls that are s nearer on both
  // sides take 6 s/H of it.
  const auto outside = [](const CaseConfig& config) {
    const Vec3 mean = mean_velocity(config, 0.5);
    const double scale = std::sqrt(0.5) / 6 * config.box.cells[2];
    return std::array{scale * (1 - mean.y / 0.5),
                      scale * (1 - (mean.x - mean.z) / std::sqrt(2.0) / (std::sqrt(128.0) / 24))};
  };
  auto config = diagonal_channel(16);
  for (double spacings : outside(config)) EXPECT_LT(std::abs(spacings), 0.1);
  config.bodies[0].thin_sheet = false;
  for (double spacings : outside(config)) EXPECT_GT(spacings, 0.3);
}

TEST(Sheet, IsTheSameOnAllNumbersOfRanks) {
  const auto config = diagonal_channel(12);
  const Vec3 shared = mean_velocity(config, 0.05), alone = mean_velocity(config, 0.05, Communicator(MPI_COMM_SELF));
  EXPECT_GT(alone.y, 0.1);
  EXPECT_LT(norm(shared - alone), 1e-12);
}

}  // namespace
}  // namespace pliant
