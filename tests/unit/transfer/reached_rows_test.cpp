#include "transfer/reached_rows.hpp"

#include <gtest/gtest.h>

#include "core/random_reals.hpp"

namespace pliant::test {
namespace {

Grid long_rows(int nx) {
  BoxConfig box;
  box.cells = {nx, 5, 6};
  box.size = {1.0 * nx, 5, 6};
  return Grid(box, BoundaryConfig{}, Communicator(MPI_COMM_SELF));
}

// Rows of up to 64 segments and of more cache lines than that.
class ReachedRowsTest : public testing::TestWithParam<int> {};

TEST_P(ReachedRowsTest, WholePlaneIsOnePartOfEveryRow) {
  const int nx = GetParam();
  ReachedRows rows(long_rows(nx));
  rows.include_plane(2);
  int parts = 0;
  for (int j = -1; j <= 5; ++j)
    rows.for_each_part(j, 2, [&](int begin, int end) {
      ++parts;
      EXPECT_EQ(begin, -1);
      EXPECT_EQ(end, nx + 1);
    });
  EXPECT_EQ(parts, 7);
  EXPECT_TRUE(rows.is_empty(0, 1));
}

TEST_P(ReachedRowsTest, PartsHoldTheNodesOfAllStencilsAndTheirPeriodicOrigins) {
  const int nx = GetParam();
  const Grid grid = long_rows(nx);
  RandomReals random(3);
  std::vector<Vec3> points{{0.1, 0.1, 3}, {nx - 0.1, 4.9, 3}};
  for (int n = 0; n < 20; ++n) points.push_back({nx * random.next(), 5 * random.next(), 6 * random.next()});
  Markers markers(grid);
  markers.place(points, std::vector<double>(points.size(), 1.0));
  ReachedRows rows(grid);
  rows.include(markers);
  rows.include_origins_of_ghosts();

  const auto expect_held = [&](int i, int j, int k) {
    bool found = false;
    rows.for_each_part(j, k, [&](int begin, int end) { found = found || (i >= begin && i < end); });
    EXPECT_TRUE(found && rows.holds(i, j, k)) << i << " " << j << " " << k;
  };
  markers.for_each_block([&](const StencilBlock& block) {
    for (int b = 0; b < block.n_batches; ++b)
      for (int l = 0; l < markers.count(block.first_batch + b); ++l)
        for (int n = 0; n < 216; ++n) {
          const auto& first = block.stencils[static_cast<std::size_t>(b)].first;
          const int lines[3] = {n & 1, 2 + (n >> 1 & 1), 4 + (n >> 2 & 1)};
          const int i = first[lines[0]][l] + n / 8 % 3, j = first[lines[1]][l] + n / 24 % 3;
          const int k = first[lines[2]][l] + n / 72;
          expect_held(i, j, k);
          expect_held((i + nx) % nx, (j + 5) % 5, k);
        }
  });
}

INSTANTIATE_TEST_SUITE_P(Rows, ReachedRowsTest, testing::Values(7, 8, 502, 503, 504, 505, 1100));

}  // namespace
}  // namespace pliant::test
