#include "transfer/mls_shape.hpp"

#include <gtest/gtest.h>

#include <random>

#include "app/generic_mls.hpp"
#include "unit/transfer/transfer_fixture.hpp"

namespace pliant::test {
namespace {

double half_width(const double (&o)[3]) {
  return std::max(1.5 * 0.5 * (o[2] - o[0]), std::max(std::abs(o[0]), std::abs(o[2])));
}

TEST(MlsStencils, AgreeWithTheGenericFourByFourSolve) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1), stretch(0.6, 1.6);
  double value_error = 0, gradient_error = 0;
  for (int round = 0; round < 400; ++round) {
    alignas(64) StencilNumbers offsets[3], weight[3], value[3], slope[3];
    for (int d = 0; d < 3; ++d)
      for (int l = 0; l < mls_batch; ++l) {
        const double h = std::exp(3 * unit(random) - 3), low = h * stretch(random), high = h * stretch(random);
        // Every seventh point is outside the three nodes, as it is next to a wall.
        const double x = l == 6 ? -low - h * unit(random) : -0.5 * low + 0.5 * (low + high) * unit(random);
        offsets[d][0][l] = -low - x, offsets[d][1][l] = -x, offsets[d][2][l] = high - x;
      }
    for (int d = 0; d < 3; ++d) mls_stencils(offsets[d], default_mls_alpha, weight[d], value[d], slope[d]);
    for (int l = 0; l < mls_batch; ++l) {
      double at[3][3];
      std::array<double, 3> reach;
      for (int d = 0; d < 3; ++d) {
        for (int k = 0; k < 3; ++k) at[d][k] = offsets[d][k][l];
        reach[static_cast<std::size_t>(d)] = default_mls_alpha * half_width(at[d]);
      }
      const GenericMls<long double> reference(at, reach);
      for (int n = 0; n < 27; ++n) {
        const int a = n % 3, b = n / 3 % 3, c = n / 9;
        const double wx = weight[0][a][l], wy = weight[1][b][l], wz = weight[2][c][l];
        const double phi =
            value[0][a][l] * wy * wz + wx * value[1][b][l] * wz + wx * wy * value[2][c][l] - 2 * wx * wy * wz;
        const double g[3] = {slope[0][a][l] * wy * wz, wx * slope[1][b][l] * wz, wx * wy * slope[2][c][l]};
        value_error = std::max(value_error, std::abs(phi - reference.value[static_cast<std::size_t>(n)]));
        for (std::size_t d = 0; d < 3; ++d)
          gradient_error =
              std::max(gradient_error, reach[d] * std::abs(g[d] - reference.gradient[d][static_cast<std::size_t>(n)]));
      }
    }
  }
  EXPECT_LT(value_error, 1e-12);
  EXPECT_LT(gradient_error, 1e-12) << "per width of the weights";
}

// The grid's stencils against stencils from the same nodes' offsets, at all kinds of points and sides.
void expect_nearest_nodes(const Grid& grid) {
  const MlsShape shape(grid);
  auto points = random_points(grid, 400);
  for (int corner = 0; corner < 8; ++corner) {
    const auto o = grid.origin(), s = grid.size();
    points.push_back({o.x + (corner & 1) * s.x, o.y + (corner >> 1 & 1) * s.y, o.z + (corner >> 2) * s.z});
  }
  for (Vec3& x : points) ASSERT_TRUE(shape.bring_into_box(x));
  double error = 0;
  for (const Vec3& x : points) {
    StencilBatch s;
    SlopeBatch g;
    shape.evaluate(std::span(&x, 1), s, g);
    for (int line = 0; line < n_stencil_lines; ++line) {
      const int d = line / 2, first = s.first[line][0];
      const int n = grid.cells()[static_cast<std::size_t>(d)];
      const auto node = [&](int i) {
        if (d == 0) return line == x_face ? grid.x_face(i) : grid.x_center(i);
        if (d == 1) return line == y_face ? grid.y_face(i) : grid.y_center(i);
        return line == z_face ? grid.global_z_face()[i] : grid.global_z_center()[i];
      };
      EXPECT_GE(first, line % 2 == 0 && !grid.is_periodic(d) ? 0 : -1);
      EXPECT_LE(first, grid.is_periodic(d) ? n - 2 : n - 3);
      const double size = grid.size()[d];
      double at = x[d];
      if (grid.is_periodic(d)) at += size * std::round((node(first + 1) - at) / size);
      alignas(64) StencilNumbers offsets, weight, value, slope;
      for (int l = 0; l < mls_batch; ++l)
        for (int i = 0; i < 3; ++i) offsets[i][l] = node(first + i) - at;
      mls_stencils(offsets, default_mls_alpha, weight, value, slope);
      for (int i = 0; i < 3; ++i) {
        error = std::max(error, std::abs(weight[i][0] - s.weight[line][i][0]));
        error = std::max(error, std::abs(value[i][0] - s.value[line][i][0]));
        error = std::max(error, grid.dx() * std::abs(slope[i][0] - g.slope[line][i][0]));
      }
      // No other node is nearer than the middle one, unless the side has pushed the nodes inwards.
      const bool pushed = !grid.is_periodic(d) && (first == (line % 2 == 0 ? 0 : -1) || first == n - 3);
      if (!pushed) {
        EXPECT_LE(std::abs(offsets[1][0]), std::abs(offsets[0][0]) + 1e-12);
        EXPECT_LE(std::abs(offsets[1][0]), std::abs(offsets[2][0]) + 1e-12);
      }
    }
  }
  EXPECT_LT(error, 1e-12);
}

TEST(MlsShape, TakesTheNearestThreeNodesAndStaysInsideWalls) {
  for (const auto& sides : {BoundaryConfig{}, walls()})
    for (const auto law : {StretchingLaw::uniform, StretchingLaw::tanh})
      expect_nearest_nodes(Grid(box_of(7, law), sides, Communicator(MPI_COMM_SELF)));
}

TEST(MlsShape, KnowsWhatIsNowhere) {
  const Grid periodic(box_of(7, StretchingLaw::uniform), BoundaryConfig{}, Communicator(MPI_COMM_SELF));
  const Grid closed(box_of(7, StretchingLaw::uniform), walls(), Communicator(MPI_COMM_SELF));
  Vec3 far{100, -100, 1000}, nan{0, std::nan(""), 0}, beyond{0, 0.4, 0};
  EXPECT_TRUE(MlsShape(periodic).bring_into_box(far));
  EXPECT_TRUE(far.x >= -1 && far.x <= 1 && far.y >= 0.5 && far.y <= 2 && far.z >= -2 && far.z <= 1);
  EXPECT_FALSE(MlsShape(periodic).bring_into_box(nan));
  EXPECT_FALSE(MlsShape(closed).bring_into_box(beyond));
}

}  // namespace
}  // namespace pliant::test
