#include "diagnostics/centered_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "boundary/side_rules.hpp"
#include "convergence/flow_fixture.hpp"

namespace pliant {
namespace {

constexpr double length = 2, height = 1.5;

// Each component a product of parabolas, straight in its own direction: differences over three points are exact, and so
// are means of two faces. About the free-slip sides x = 0 and z = height the components along them are even.
double u_at(Vec3 x) { return (1 + 0.3 * x.x) * (1 + x.y - 0.4 * x.y * x.y) * (2 + (height - x.z) * (height - x.z)); }
double v_at(Vec3 x) { return (2 - x.x * x.x) * (1 - 0.2 * x.y) * (1 - 0.5 * (height - x.z) * (height - x.z)); }
double w_at(Vec3 x) { return (1 + 0.6 * x.x * x.x) * (3 - x.y + x.y * x.y) * (0.5 + x.z); }

Vec3 vorticity_at(Vec3 x) {
  const double t = height - x.z;
  const double u_y = (1 + 0.3 * x.x) * (1 - 0.8 * x.y) * (2 + t * t), u_z = u_at(x) / (2 + t * t) * (-2 * t);
  const double v_x = -2 * x.x * (1 - 0.2 * x.y) * (1 - 0.5 * t * t), v_z = (2 - x.x * x.x) * (1 - 0.2 * x.y) * t;
  const double w_x = 1.2 * x.x * (3 - x.y + x.y * x.y) * (0.5 + x.z);
  const double w_y = (1 + 0.6 * x.x * x.x) * (2 * x.y - 1) * (0.5 + x.z);
  return {w_y - v_z, u_z - w_x, v_x - u_y};
}

BoundaryConfig sides_of_all_kinds() {
  BoundaryConfig sides;
  sides[0] = FreeSlipSide{};
  sides[1] = WallSide{};
  sides[2] = InflowSide{{0, 1, 0}};
  sides[3] = OutflowSide{};
  sides[4] = WallSide{};
  sides[5] = FreeSlipSide{};
  return sides;
}

/// The field with ghosts as the side's rules make them of given values: what is known on a side is there the mean of
/// ghost and cell.
template <class Location, class Value>
void fill(Field<Location>& field, const Grid& grid, const BoundaryConfig& sides, int component, Value value) {
  const auto rules = velocity_rules(sides, component);
  const auto f = field.view();
  const std::array<int, 3> n{grid.nx(), grid.ny(), grid.nz()};
  const std::array<bool, 3> has_lower{true, true, grid.has_bottom()}, has_upper{true, true, grid.has_top()};
  for (int k = -1; k <= n[2]; ++k)
    for (int j = -1; j <= n[1]; ++j)
      for (int i = -1; i <= n[0]; ++i) f(i, j, k) = value(test::position_of(grid, component, i, j, k));
  for (std::size_t d = 0; d < 3; ++d) {
    if (static_cast<int>(d) == component) continue;
    for (int upper = 0; upper < 2; ++upper) {
      const auto& rule = rules[2 * d + static_cast<std::size_t>(upper)];
      if (rule.sign != -1 || !(upper ? has_upper[d] : has_lower[d])) continue;
      for (int b = -1; b <= n[(d + 2) % 3]; ++b)
        for (int a = -1; a <= n[(d + 1) % 3]; ++a) {
          std::array<int, 3> ghost{};
          ghost[(d + 1) % 3] = a;
          ghost[(d + 2) % 3] = b;
          ghost[d] = upper ? n[d] : -1;
          auto cell = ghost;
          cell[d] += upper ? -1 : 1;
          Vec3 side = test::position_of(grid, component, ghost[0], ghost[1], ghost[2]);
          side[static_cast<int>(d)] = upper ? grid.origin()[static_cast<int>(d)] + grid.size()[static_cast<int>(d)]
                                            : grid.origin()[static_cast<int>(d)];
          f(ghost[0], ghost[1], ghost[2]) = 2 * value(side) - f(cell[0], cell[1], cell[2]);
        }
    }
  }
}

TEST(CenteredFlow, VorticityOfParabolasIsExactAtSidesOfAllKinds) {
  const auto sides = sides_of_all_kinds();
  const auto grid = test::make_grid({7, 6, 9}, {length, length, height}, sides, {StretchingLaw::tanh, 1.5});
  FlowState state(grid);
  fill(state.u, grid, sides, 0, u_at);
  fill(state.v, grid, sides, 1, v_at);
  fill(state.w, grid, sides, 2, w_at);
  const CenteredFlow centered(grid, sides);
  double largest = 0;
  for (int k = 0; k < grid.nz(); ++k)
    for (int j = 0; j < grid.ny(); ++j)
      for (int i = 0; i < grid.nx(); ++i) {
        const Vec3 x{grid.x_center(i), grid.y_center(j), grid.z_center()[k]};
        const Vec3 found = centered.vorticity(state, i, j, k), expected = vorticity_at(x);
        EXPECT_LT(norm(found - expected), 1e-12) << i << " " << j << " " << k;
        EXPECT_LT(norm(centered.velocity(state, i, j, k) - Vec3{u_at(x), v_at(x), w_at(x)}), 1e-13);
        largest = std::max(largest, norm(expected));
      }
  EXPECT_GT(largest, 1);
}

// Vortices between walls that drag along them, through the solver's own ghosts: fourfold at half the spacing, at the
// walls as inside.
TEST(CenteredFlow, VorticityIsOfSecondOrderBetweenWalls) {
  constexpr double pi = 3.14159265358979323846;
  double errors[2];
  for (int level = 0; level < 2; ++level) {
    const int n = 16 << level;
    const auto sides = test::walls_along(2);
    const auto grid = test::make_grid({n, 4, n}, {1, 1, 1}, sides, {StretchingLaw::tanh, 1.0});
    auto solver = test::make_solver(grid, sides, 0.1, ViscousMode::implicit);
    // The stream function sin^2(pi z) cos(2 pi x).
    auto& state = solver.state();
    for (int k = 0; k < grid.nz(); ++k)
      for (int j = 0; j < grid.ny(); ++j)
        for (int i = 0; i < grid.nx(); ++i) {
          const Vec3 a = test::position_of(grid, 0, i, j, k), c = test::position_of(grid, 2, i, j, k);
          state.u.view()(i, j, k) = pi * std::sin(2 * pi * a.z) * std::cos(2 * pi * a.x);
          state.w.view()(i, j, k) = 2 * pi * std::pow(std::sin(pi * c.z), 2) * std::sin(2 * pi * c.x);
        }
    solver.fill_ghosts();
    const CenteredFlow centered(grid, sides);
    double error = 0;
    for (int k = 0; k < grid.nz(); ++k)
      for (int i = 0; i < grid.nx(); ++i) {
        const double x = grid.x_center(i), z = grid.z_center()[k];
        const double expected =
            2 * pi * pi * std::cos(2 * pi * x) * (std::cos(2 * pi * z) - 2 * std::pow(std::sin(pi * z), 2));
        const Vec3 found = centered.vorticity(solver.state(), i, 1, k);
        error = std::max(error, norm(found - Vec3{0, expected, 0}));
      }
    errors[level] = grid.ranks().max(error);
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.2);
}

}  // namespace
}  // namespace pliant
