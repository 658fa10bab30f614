#include <gtest/gtest.h>

#include <numbers>

#include "convergence/flow_fixture.hpp"

namespace pliant::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr ViscousMode modes[] = {ViscousMode::explicit_rk3, ViscousMode::implicit_z, ViscousMode::implicit};

// Start-up of plane Couette flow, h = nu = U = 1 (validation.md, section 7).
double couette_series(double y, double t) {
  double u = y;
  for (int n = 1; n < 200; ++n)
    u += 2 / pi * (n % 2 == 0 ? 1 : -1) / n * std::sin(n * pi * y) * std::exp(-n * n * pi * pi * t);
  return u;
}

// Start-up of plane Poiseuille flow under a unit acceleration, h = nu = 1.
double poiseuille_series(double y, double t) {
  double u = 0.5 * y * (1 - y);
  for (int n = 1; n < 200; n += 2) u -= 4 / std::pow(pi * n, 3) * std::sin(n * pi * y) * std::exp(-n * n * pi * pi * t);
  return u;
}

struct ChannelSetup {
  int normal, direction, n;
  ViscousMode mode;
  StretchingLaw law = StretchingLaw::uniform;
};

Grid channel_grid(const ChannelSetup& s, const BoundaryConfig& sides) {
  std::array<int, 3> cells{4, 4, 4};
  cells[static_cast<std::size_t>(s.normal)] = s.n;
  return make_grid(cells, {1, 1, 1}, sides, {s.normal == 2 ? s.law : StretchingLaw::uniform, 1.2});
}

int steps_for(const Grid& grid, ViscousMode mode, double end, int accurate) {
  return std::max(accurate, static_cast<int>(end / viscous_step_limit(grid, 1.0, mode)) + 1);
}

double couette_error(const ChannelSetup& s) {
  Vec3 wall;
  wall[s.direction] = 1;
  const auto sides = walls_along(s.normal, {}, wall);
  const Grid grid = channel_grid(s, sides);
  FlowSolver solver = make_solver(grid, sides, 1.0, s.mode);
  // The impulsive start is singular: begin on the series.
  const double start = 0.02, end = 0.1;
  const auto exact = [&](double t) {
    return [&s, t](Vec3 p) {
      Vec3 u;
      u[s.direction] = couette_series(p[s.normal], t);
      return u;
    };
  };
  set_velocity(solver, exact(start));
  run(solver, end - start, steps_for(grid, s.mode, end - start, 4 * s.n));
  return largest_error(solver, exact(end));
}

double poiseuille_error(const ChannelSetup& s) {
  const auto sides = walls_along(s.normal);
  const Grid grid = channel_grid(s, sides);
  ForcingConfig forcing;
  forcing.acceleration[s.direction] = 1;
  FlowSolver solver = make_solver(grid, sides, 1.0, s.mode, forcing);
  const double end = 0.1;
  run(solver, end, steps_for(grid, s.mode, end, 8 * s.n));
  return largest_error(solver, [&](Vec3 p) {
    Vec3 u;
    u[s.direction] = poiseuille_series(p[s.normal], end);
    return u;
  });
}

void expect_second_order(double (*error)(const ChannelSetup&), const ChannelSetup& coarse) {
  ChannelSetup fine = coarse;
  fine.n *= 2;
  const double e1 = error(coarse), e2 = error(fine);
  EXPECT_NEAR(std::log2(e1 / e2), 2.0, 0.2)
      << "normal " << coarse.normal << " direction " << coarse.direction << " mode " << static_cast<int>(coarse.mode)
      << " stretching " << static_cast<int>(coarse.law) << " errors " << e1 << " " << e2;
}

TEST(Channel, CouetteStartUpConvergesForWallsInEveryDirection) {
  for (int normal = 0; normal < 3; ++normal)
    for (ViscousMode mode : modes) expect_second_order(couette_error, {normal, (normal + 1) % 3, 16, mode});
  expect_second_order(couette_error, {2, 1, 16, ViscousMode::implicit, StretchingLaw::tanh});
}

TEST(Channel, PoiseuilleStartUpConvergesForWallsInEveryDirection) {
  for (int normal = 0; normal < 3; ++normal)
    for (ViscousMode mode : modes) expect_second_order(poiseuille_error, {normal, (normal + 2) % 3, 16, mode});
  expect_second_order(poiseuille_error, {2, 0, 16, ViscousMode::implicit_z, StretchingLaw::tanh});
}

TEST(Channel, SteadyPoiseuilleIsKeptToRoundOff) {
  for (ViscousMode mode : modes)
    for (int normal = 0; normal < 3; ++normal) {
      const auto sides = walls_along(normal);
      const int direction = (normal + 1) % 3;
      const Grid grid = channel_grid({normal, direction, 16, mode}, sides);
      ForcingConfig forcing;
      forcing.acceleration[direction] = 1;
      FlowSolver solver = make_solver(grid, sides, 1.0, mode, forcing);
      // The parabola with the wall value half a cell away by reflection: exact for the discrete operator but for a
      // constant, so start from it and let it settle.
      const double h = 1.0 / 16;
      const auto exact = [&](Vec3 p) {
        Vec3 u;
        u[direction] = 0.5 * p[normal] * (1 - p[normal]) + h * h / 8;
        return u;
      };
      set_velocity(solver, exact);
      for (int n = 0; n < 20; ++n) solver.advance(1e-3);
      EXPECT_LT(largest_error(solver, exact), 1e-14) << "normal " << normal << " mode " << static_cast<int>(mode);
    }
}

// Steady plane Poiseuille flow of mean velocity G h^2 / (12 nu) needs the acceleration G.
TEST(Channel, ConstantMassFluxIsHeldAndBalancesTheWallStress) {
  const auto sides = walls_along(2);
  ForcingConfig forcing;
  forcing.bulk_velocity = ForcingConfig::BulkVelocity{Axis::y, 1.0 / 12};
  const auto error = [&](int n) {
    const Grid grid = make_grid({4, 4, n}, {1, 1, 1}, sides, {StretchingLaw::tanh, 1.5});
    FlowSolver solver = make_solver(grid, sides, 1.0, ViscousMode::implicit, forcing);
    for (int step = 0; step < 10 * n * n; ++step) solver.advance(0.1 / (n * n));
    EXPECT_NEAR(solver.bulk_velocity().y, 1.0 / 12, 1e-14);
    return std::abs(solver.bulk_forcing() - 1);
  };
  EXPECT_NEAR(std::log2(error(12) / error(24)), 2.0, 0.2);
}

}  // namespace
}  // namespace pliant::test
