#include "transfer/point_router.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "core/random_reals.hpp"

namespace pliant {
namespace {

struct Setting {
  std::string name;
  Grid grid;
};

Grid make_grid(int planes, bool periodic, double stretching) {
  BoxConfig box;
  box.size = {2, 3, 5};
  box.origin = {-1, 0.5, -2};
  box.cells = {6, 5, planes};
  if (stretching > 0) box.stretching_z = {StretchingLaw::tanh, stretching};
  BoundaryConfig boundary;
  if (!periodic) boundary[4] = boundary[5] = WallSide{};
  return Grid(box, boundary, Communicator());
}

/// Slabs of one plane, of one and two, and of several; periodic, bounded, stretched.
std::vector<Setting> settings() {
  const int ranks = Communicator().size();
  std::vector<Setting> all;
  for (const int planes : {std::max(ranks, 3), 2 * ranks + 1, 13})
    for (const bool periodic : {true, false})
      for (const double stretching : {0.0, 1.5})
        all.push_back({std::to_string(planes) + (periodic ? " periodic planes" : " bounded planes") +
                           (stretching > 0 ? ", stretched" : ""),
                       make_grid(planes, periodic, stretching)});
  return all;
}

/// Points of a rank, anywhere in the box; on borders between cells and on sides; the last rank of several has none.
/// Along periodic directions they may be some periods away.
std::vector<Vec3> points_of(const Grid& grid, int rank, int ranks) {
  std::vector<Vec3> points;
  if (ranks > 1 && rank == ranks - 1) return points;
  RandomReals random(static_cast<std::uint64_t>(7 + rank));
  const double periods[] = {0, 0, 1, -2};
  for (int n = 0; n < 60 + 10 * rank; ++n) {
    Vec3 x;
    for (int d = 0; d < 3; ++d) {
      x[d] = grid.origin()[d] + grid.size()[d] * random.next();
      if (grid.is_periodic(d)) x[d] += grid.size()[d] * periods[n % 4];
    }
    if (n % 10 == 3) x.z = grid.global_z_face()[n % grid.cells()[2]];
    if (n % 10 == 7) x.z = grid.origin().z;
    points.push_back(x);
  }
  return points;
}

/// Rank and index of every point that this rank holds, in order.
std::vector<std::pair<int, int>> senders(const PointRouter& router, const Communicator& ranks) {
  std::vector<double> own, held;
  for (std::size_t n = 0; n < router.n_own(); ++n) {
    own.push_back(ranks.rank());
    own.push_back(static_cast<double>(n));
  }
  router.send(own, 2, held);
  std::vector<std::pair<int, int>> result;
  for (std::size_t n = 0; n < held.size(); n += 2)
    result.emplace_back(static_cast<int>(held[n]), static_cast<int>(held[n + 1]));
  return result;
}

double wrapped(const Grid& grid, double z) {
  const double height = grid.size().z, lower = grid.origin().z;
  return grid.is_periodic(2) ? z - height * std::floor((z - lower) / height) : z;
}

TEST(PointRouter, EveryStencilIsHeldByExactlyOneRank) {
  const Communicator ranks;
  for (const auto& [name, grid] : settings()) {
    const auto points = points_of(grid, ranks.rank(), ranks.size());
    PointRouter router(grid);
    router.route(points);
    EXPECT_EQ(router.n_own(), points.size());
    const MlsShape shape(grid);
    std::vector<double> holders;  // of the centre and the face stencil of each held point
    StencilBatch stencils;
    SlopeBatch slopes;
    for (const Vec3 x : router.held()) {
      const bool near = shape.is_near(x.z);
      if (near) shape.evaluate(std::span(&x, 1), stencils, slopes);
      holders.push_back(near && shape.is_held(stencils, z_center, 0) ? 1 : 0);
      holders.push_back(near && shape.is_held(stencils, z_face, 0) ? 1 : 0);
    }
    std::vector<double> sums(2 * points.size());
    router.collect(holders, 2, sums);
    EXPECT_EQ(sums, std::vector<double>(sums.size(), 1.0)) << name;
  }
}

TEST(PointRouter, PointsComeWrappedOnceAndInOrder) {
  const Communicator ranks;
  for (const auto& [name, grid] : settings()) {
    PointRouter router(grid);
    router.route(points_of(grid, ranks.rank(), ranks.size()));
    const auto from = senders(router, ranks);
    ASSERT_EQ(from.size(), router.held().size());
    for (std::size_t n = 0; n < from.size(); ++n) {
      if (n > 0) { EXPECT_LT(from[n - 1], from[n]) << name << ": by rank, then as they were given, none twice"; }
      const Vec3 x = points_of(grid, from[n].first, ranks.size())[static_cast<std::size_t>(from[n].second)];
      for (int d = 0; d < 3; ++d) {
        const double periods = (router.held()[n][d] - x[d]) / grid.size()[d];
        EXPECT_NEAR(periods, std::round(periods), 1e-13) << name;
        EXPECT_GE(router.held()[n][d], grid.origin()[d]);
        EXPECT_LE(router.held()[n][d], grid.origin()[d] + grid.size()[d]);
      }
    }
  }
}

TEST(PointRouter, NumbersGoThereAndTheirSumComesBack) {
  const Communicator ranks;
  for (const auto& [name, grid] : settings()) {
    const auto points = points_of(grid, ranks.rank(), ranks.size());
    PointRouter router(grid);
    router.route(points);
    std::vector<Vec3> own(points.size()), held;
    for (std::size_t n = 0; n < own.size(); ++n) own[n] = {1.0 * ranks.rank(), 0.5 + static_cast<double>(n), -3};
    router.send(own, held);
    const auto from = senders(router, ranks);
    for (std::size_t n = 0; n < held.size(); ++n)
      EXPECT_EQ(held[n], (Vec3{1.0 * from[n].first, 0.5 + from[n].second, -3}));
    // Holders say 1 and their rank: a sum over all that hold the point.
    std::vector<double> said, sums(2 * points.size());
    for (std::size_t n = 0; n < held.size(); ++n) said.insert(said.end(), {1.0, 1.0 * ranks.rank()});
    router.collect(said, 2, sums);
    long copies = 0;
    for (std::size_t n = 0; n < points.size(); ++n) {
      EXPECT_GE(sums[2 * n], 1) << name;
      EXPECT_LE(sums[2 * n], ranks.size());
      copies += std::lround(sums[2 * n]);
    }
    EXPECT_EQ(ranks.sum(copies), ranks.sum(static_cast<long>(held.size())));
  }
}

TEST(PointRouter, ReachBringsPointsToAllWhoseSlabIsThatNear) {
  const Communicator ranks;
  for (const auto& [name, grid] : settings()) {
    const double lower = grid.z_face()[-1], upper = grid.z_face()[grid.nz() - 1], height = grid.size().z;
    for (const double reach : {0.3, 1.1, 2.4, 20.0}) {
      PointRouter router(grid);
      router.route(points_of(grid, ranks.rank(), ranks.size()), reach);
      const auto from = senders(router, ranks);
      const std::set<std::pair<int, int>> held(from.begin(), from.end());
      EXPECT_EQ(held.size(), from.size()) << name << ": none twice";
      for (int r = 0; r < ranks.size(); ++r) {
        const auto points = points_of(grid, r, ranks.size());
        for (std::size_t n = 0; n < points.size(); ++n) {
          const double z = wrapped(grid, points[n].z);
          double distance = std::max({0.0, lower - z, z - upper});
          if (grid.is_periodic(2))
            distance = std::min({distance, std::max(0.0, lower + height - z), std::max(0.0, z + height - upper)});
          // Strictly nearer, by more than round-off.
          if (distance >= reach * (1 - 1e-12)) continue;
          EXPECT_TRUE(held.contains({r, static_cast<int>(n)})) << name << ", reach " << reach << ", z " << z;
        }
      }
    }
  }
}

TEST(PointRouter, FindsTheFirstPointOutside) {
  const Communicator ranks;
  const PointRouter bounded(make_grid(13, false, 0)), periodic(make_grid(13, true, 0));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec3> points{{0, 1, 0}, {50, -30, -2}, {0, 1, 3}, {0, 1, 3.0001}, {0, nan, 0}};
  EXPECT_EQ(bounded.first_outside(points), 3u) << "x and y are periodic, and the sides belong to the box";
  EXPECT_EQ(periodic.first_outside(points), 4u);
  EXPECT_EQ(bounded.first_outside(std::span(points).first(3)), 3u);
  EXPECT_EQ(bounded.first_outside({}), 0u);
}

}  // namespace
}  // namespace pliant
