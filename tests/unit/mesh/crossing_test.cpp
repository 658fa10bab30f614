#include "mesh/crossing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/distance.hpp"
#include "mesh/shapes/box.hpp"
#include "mesh/shapes/icosphere.hpp"
#include "mesh/shapes/plate.hpp"

namespace pliant {
namespace {

Surface moved(Surface surface, Vec3 by) {
  for (Vec3& x : surface.positions) x += by;
  return surface;
}
SurfaceView view(const Surface& surface) { return {surface.mesh, surface.positions}; }

TEST(Crossing, BoxesThatReachIntoEachOtherDo) {
  const auto box = make_box({1, 1, 1}, 0.3);
  EXPECT_TRUE(find_crossing(view(box), view(moved(box, {0.9, 0.05, 0.1})), 1e-9));
  EXPECT_TRUE(find_crossing(view(box), view(moved(box, {1 - 1e-6, 0.05, 0.1})), 1e-9));
  EXPECT_FALSE(find_crossing(view(box), view(moved(box, {1 + 1e-6, 0.05, 0.1})), 1e-9));
  EXPECT_FALSE(find_crossing(view(box), view(moved(box, {1.2, 0, 0})), 1e-9));
  EXPECT_FALSE(find_crossing(view(box), view(make_box({0.5, 0.5, 0.5}, 0.2)), 1e-9));  // one inside the other
}

TEST(Crossing, SpheresCrossExactlyWhereBothSurfacesAre) {
  const auto sphere = make_icosphere(8, 1.0);
  const auto other = moved(sphere, {1.2, 0.7, 0.3});
  const auto at = find_crossing(view(sphere), view(other), 1e-9);
  ASSERT_TRUE(at);
  // On both polyhedra, whose faces lie within 1 - cos(face angle) = 0.01 of their spheres.
  EXPECT_NEAR(norm(*at), 1, 0.01);
  EXPECT_NEAR(norm(*at - Vec3{1.2, 0.7, 0.3}), 1, 0.01);
}

TEST(Crossing, ThePointIsInTheFaceOfAPlate) {
  const auto plate = make_plate(2, 2, 0.5);
  auto upright = make_plate(0.4, 0.4, 0.4);
  for (Vec3& x : upright.positions) x = {x.x + 0.13, 0.21, x.y + 0.1};
  const auto at = find_crossing(view(plate), view(upright), 1e-9);
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->z, 0, 1e-15);
  EXPECT_NEAR(at->y, 0.21, 1e-15);
  EXPECT_FALSE(find_crossing(view(plate), view(moved(upright, {0, 0, 0.1 + 1e-6})), 1e-9));
}

TEST(Crossing, SheetsOnTopOfEachOtherAreFound) {
  const auto plate = make_plate(2, 2, 0.5);
  EXPECT_TRUE(find_common_sheet(view(plate), view(moved(plate, {0.3, 0.1, 0})), 1e-9));
  EXPECT_TRUE(find_common_sheet(view(plate), view(plate), 1e-9));
  EXPECT_FALSE(find_common_sheet(view(plate), view(moved(plate, {0.3, 0.1, 1e-3})), 1e-9));
  EXPECT_FALSE(find_common_sheet(view(plate), view(moved(plate, {2, 0, 0})), 1e-9));  // side by side
}

TEST(Crossing, AFoldedSurfaceCrossesItself) {
  auto plate = make_plate(4, 1, 0.3);
  EXPECT_FALSE(find_self_crossing(view(plate), 1e-9));
  auto spiral = plate, ring = plate;  // of a little more than one turn
  for (std::size_t v = 0; v < plate.positions.size(); ++v) {
    const Vec3 x = plate.positions[v];
    const Vec3 turned{std::cos(1.7 * x.x), x.y, std::sin(1.7 * x.x)};
    spiral.positions[v] = {(1 + 0.1 * x.x) * turned.x, x.y, (1 + 0.1 * x.x) * turned.z};
    ring.positions[v] = {turned.x + 0.1 * x.y * x.x, x.y, turned.z};
  }
  EXPECT_FALSE(find_self_crossing(view(spiral), 1e-9));
  EXPECT_TRUE(find_self_crossing(view(ring), 1e-9));
  EXPECT_FALSE(find_self_crossing(view(make_icosphere(8, 1.0)), 1e-9));
}

TEST(Distance, WindsOnceInsideAndNotOutside) {
  const auto box = make_box({1, 1, 1}, 0.3);
  EXPECT_NEAR(winding_number({0.1, 0.2, -0.3}, box.mesh, box.positions), 1, 1e-14);
  EXPECT_NEAR(winding_number({0.499999, 0.2, -0.3}, box.mesh, box.positions), 1, 1e-12);
  EXPECT_NEAR(winding_number({0.500001, 0.2, -0.3}, box.mesh, box.positions), 0, 1e-12);
  EXPECT_NEAR(winding_number({3, 2, 1}, box.mesh, box.positions), 0, 1e-14);
}

TEST(Distance, NearestPointIsNoFurtherThanAnyOther) {
  const Triangle triangle{Vec3{0, 0, 0}, Vec3{2, 0.3, 0.1}, Vec3{0.4, 1.1, -0.5}};
  for (int n = 0; n < 200; ++n) {
    const Vec3 x{3 * std::sin(1.3 * n), 3 * std::cos(2.1 * n + 1), 2 * std::sin(0.7 * n + 2)};
    const double nearest = norm(nearest_point(x, triangle) - x);
    double sampled = 1e9;
    for (int i = 0; i <= 60; ++i)
      for (int j = 0; j <= 60 - i; ++j) {
        const Vec3 point = (i * triangle[0] + j * triangle[1] + (60 - i - j) * triangle[2]) / 60;
        sampled = std::min(sampled, norm(point - x));
      }
    EXPECT_LE(nearest, sampled + 1e-14);
    EXPECT_GE(nearest, sampled - 2.1 / 60);  // samples are no further apart than a side over 60
  }
}

}  // namespace
}  // namespace pliant
