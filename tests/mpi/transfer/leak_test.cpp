#include <gtest/gtest.h>

#include "mpi/transfer/sphere_in_flow.hpp"
#include "unit/transfer/transfer_fixture.hpp"

namespace pliant::test {
namespace {

// Enough for the impulse of the start to be over: what is left of the slip is that of one forcing a substep.
constexpr int steps = 15;

SphereInFlow small_flow() {
  SphereInFlow flow;
  flow.cells = 24;
  flow.diameter = 12;
  return flow;
}

TEST(Leak, OfACoarseSurfaceVanishesByRefinement) {
  // 320 faces with edges of 2 cells; the limit is markers many to a cell.
  const auto limit = measure_leak(small_flow(), 4, 6, steps);
  const auto coarse = measure_leak(small_flow(), 4, 1, steps);
  const auto refined = measure_leak(small_flow(), 4, 0, steps);
  EXPECT_GT(refined.markers, coarse.markers);
  EXPECT_LT(refined.markers, limit.markers);
  EXPECT_GT(coarse.through, 1.3 * limit.through) << "the surface leaks between its markers";
  EXPECT_GT(coarse.largest, 1.4 * limit.largest);
  EXPECT_LT(refined.through - limit.through, 0.1 * (coarse.through - limit.through));
  EXPECT_LT(refined.rms - limit.rms, 0.2 * (coarse.rms - limit.rms));
  EXPECT_LT(refined.largest - limit.largest, 0.2 * (coarse.largest - limit.largest));
  EXPECT_LT(refined.through, 0.03) << "what one forcing before the projection leaves";
}

TEST(Leak, OfAVeryCoarseSurfaceVanishesAsWell) {
  // 80 faces with edges of 4 cells cannot even be computed without refinement.
  const Grid grid = make_grid(small_flow());
  auto surface = make_icosphere(2, 6.0);
  for (Vec3& x : surface.positions) x += center_of(small_flow());
  const std::vector<Vec3> rest(surface.positions.size());
  const auto largest_correction = [&](const MarkerLayout& layout) {
    MarkerSet markers;
    layout.place(surface.positions, rest, markers);
    DirectForcing forcing(grid, 1.0);
    forcing.place(markers.positions, markers.areas, markers.velocities);
    return grid.ranks().max(forcing.largest_correction());
  };
  EXPECT_GT(largest_correction(MarkerLayout(surface.mesh)), DirectForcing::largest_stable_correction);
  EXPECT_LT(largest_correction(MarkerLayout(surface.mesh, refinement_for(surface.mesh, surface.positions, 1.0))), 1);

  const auto refined = measure_leak(small_flow(), 2, 0, steps), limit = measure_leak(small_flow(), 2, 12, steps);
  EXPECT_LT(refined.through, 1.05 * limit.through);
  EXPECT_LT(refined.rms, 1.15 * limit.rms);
}

TEST(DirectForcing, OvershootsWhereAMarkerSpeaksForTooMuch) {
  // One marker on a node of u in a flow of speed 1: afterwards it finds 1 - c sum phi^2, with sum phi^2 near 1.
  const Grid grid = make_grid(small_flow(), Communicator(MPI_COMM_SELF));
  const std::vector<Vec3> position{{grid.x_face(9), grid.y_center(11), grid.z_center()[10]}}, rest(1);
  for (const double area : {0.5, 1.0, 1.5, 3.0}) {
    VelocityFields f(grid);
    set_velocity(grid, f, [](int c, Vec3) { return c == 0 ? 1.0 : 0.0; });
    DirectForcing forcing(grid, 1.0);
    forcing.place(position, std::vector<double>{area}, rest);
    EXPECT_NEAR(forcing.largest_correction(), area, 1e-12) << "A h / dx^3 on cells of size 1";
    forcing.apply({0, 0, 0, 1.0}, 1.0, f.u.view(), f.v.view(), f.w.view());
    std::vector<Vec3> found(1);
    forcing.add_velocities(f.u.view(), f.v.view(), f.w.view(), found);
    if (area < DirectForcing::largest_stable_correction) {
      EXPECT_LT(std::abs(found[0].x), 1);
    } else {
      EXPECT_GT(std::abs(found[0].x), 1);
    }
  }
}

TEST(DirectForcing, GivesVelocitiesInTheCallersOrder) {
  const Grid grid(box_of(8, StretchingLaw::tanh), walls(), Communicator());
  VelocityFields f(grid);
  const auto linear = [](int c, Vec3 x) { return 1 + c + (c + 1) * x.x - 2 * x.y + (3 - c) * x.z; };
  set_velocity(grid, f, linear);
  const auto points = random_points(grid, 200);
  DirectForcing forcing(grid, 1.0);
  forcing.place(points, std::vector<double>(points.size(), 0.01), std::vector<Vec3>(points.size()));
  std::vector<Vec3> found(points.size());
  forcing.add_velocities(f.u.view(), f.v.view(), f.w.view(), found);
  std::vector<double> numbers;
  for (Vec3 u : found) numbers.insert(numbers.end(), {u.x, u.y, u.z});
  grid.ranks().sum(numbers);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(numbers[3 * i + static_cast<std::size_t>(c)], linear(c, points[i]), 1e-12);
}

}  // namespace
}  // namespace pliant::test
