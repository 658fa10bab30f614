#include "diagnostics/cavity_flow.hpp"

#include <gtest/gtest.h>

#include "convergence/flow_fixture.hpp"
#include "mesh/geometry.hpp"
#include "mesh/shapes/icosphere.hpp"

namespace pliant {
namespace {

/// The flow a + B x, at all points and beyond.
FlowState linear_flow(const Grid& grid, Vec3 a, const Mat3& b) {
  FlowState state(grid);
  for (int k = -1; k <= grid.nz(); ++k)
    for (int j = -1; j <= grid.ny(); ++j)
      for (int i = -1; i <= grid.nx(); ++i) {
        const auto at = [&](int c) { return a[c] + dot(b[c], test::position_of(grid, c, i, j, k)); };
        state.u.view()(i, j, k) = at(0);
        state.v.view()(i, j, k) = at(1);
        state.w.view()(i, j, k) = at(2);
      }
  return state;
}

struct Ball {
  Grid grid = test::make_grid({14, 15, 16}, {3, 3, 3}, test::periodic_box());
  std::vector<InsidePiece> pieces;
  double volume = 0;  // of the pieces

  Ball() {
    auto ball = make_icosphere(6, 1.0);
    for (Vec3& x : ball.positions) x += Vec3{1.4, 1.55, 1.5};
    pieces = find_inside(grid, ball.mesh.vertices_of_face(), ball.positions, 1);
    for (const auto& piece : pieces) volume += (piece.to - piece.from) * grid.dx() * grid.dy();
    EXPECT_NEAR(volume, enclosed_volume(ball.mesh, ball.positions), 0.01 * volume);
  }
};

TEST(CavityFlow, OfAUniformFlowIsItsEnergyTimesTheVolume) {
  const Ball ball;
  const auto flow = find_cavity_flow(ball.grid, ball.pieces, linear_flow(ball.grid, {1, -2, 3}, {}),
                                     CenteredFlow(ball.grid, test::periodic_box()), 1.5, {});
  EXPECT_NEAR(flow.volume, ball.volume, 1e-13);
  EXPECT_NEAR(flow.kinetic_energy, 0.5 * 1.5 * 14 * ball.volume, 1e-12);
  EXPECT_NEAR(flow.enstrophy, 0, 1e-24);
  EXPECT_EQ(flow.jet_depth, 0);
}

TEST(CavityFlow, OfARotationHasTheEnstrophyOfTwiceItsRate) {
  const Ball ball;
  // x -> (1, 2, 2) x x.
  const Mat3 rotation{Vec3{0, -2, 2}, Vec3{2, 0, -1}, Vec3{-2, 1, 0}};
  const auto flow = find_cavity_flow(ball.grid, ball.pieces, linear_flow(ball.grid, {}, rotation),
                                     CenteredFlow(ball.grid, test::periodic_box()), 1, {});
  EXPECT_NEAR(flow.enstrophy, 0.5 * 36 * ball.volume, 1e-10);
}

TEST(CavityFlow, AJetReachesDownToTheLastCellThatIsFastEnough) {
  const Ball ball;
  // Downwards the faster, the higher: 0 at z = 0.5, 2 at the top of the ball.
  const auto state = linear_flow(ball.grid, {0, 0, 0.5}, {Vec3{}, Vec3{}, Vec3{0, 0, -1}});
  const auto depth = [&](double threshold) {
    return find_cavity_flow(ball.grid, ball.pieces, state, CenteredFlow(ball.grid, test::periodic_box()), 1,
                            JetConfig{{1.4, 1.5, 2.5}, {0, 0, -2}, threshold})
        .jet_depth;
  };
  const double h = 3.0 / 16;
  for (const double threshold : {0.4, 0.8, 1.5}) {
    double lowest = 0.5 * h;  // of the centres above the height where the velocity is at its threshold
    while (lowest <= 0.5 + threshold) lowest += h;
    EXPECT_NEAR(depth(threshold), 2.5 - lowest, 1e-12) << threshold;
  }
  EXPECT_EQ(depth(5), 0);
}

}  // namespace
}  // namespace pliant
