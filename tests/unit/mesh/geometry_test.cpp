#include "mesh/geometry.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "mesh/describe.hpp"
#include "mesh/shapes/icosphere.hpp"
#include "unit/mesh/box_at.hpp"
#include "unit/mesh/patches.hpp"

namespace pliant {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Geometry, KnowsTheMomentsOfABoxFarFromTheOrigin) {
  const Vec3 corner{100, -200, 300}, sides{1, 2, 3};
  const auto box = make_box_at(corner, sides);
  EXPECT_NEAR(total_area(box.mesh, box.positions), 22.0, 1e-12);
  EXPECT_NEAR(enclosed_volume(box.mesh, box.positions), 6.0, 1e-12);
  const auto moments = enclosed_moments(box.mesh, box.positions);
  EXPECT_NEAR(moments.volume, 6.0, 1e-12);
  EXPECT_NEAR(norm(moments.centroid - (corner + 0.5 * sides)), 0.0, 1e-12);
  const Mat3 inertia = moments.inertia();
  const double expected[3] = {6.0 * (4 + 9) / 12, 6.0 * (1 + 9) / 12, 6.0 * (1 + 4) / 12};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(inertia[i][j], i == j ? expected[i] : 0.0, 1e-11);
}

TEST(Geometry, MeasuresAnEquilateralPatch) {
  const auto patch = make_lattice_patch(4);
  for (double length : edge_lengths(patch.mesh, patch.positions)) EXPECT_NEAR(length, 1.0, 1e-14);
  for (double area : face_areas(patch.mesh, patch.positions)) EXPECT_NEAR(area, std::sqrt(3.0) / 4, 1e-14);
  for (const auto& corners : face_angles(patch.mesh, patch.positions))
    for (double angle : corners) EXPECT_NEAR(angle, pi / 3, 1e-14);
  for (double angle : hinge_angles(patch.mesh, patch.positions)) EXPECT_NEAR(angle, 0.0, 1e-14);
  for (const Vec3& normal : face_normals(patch.mesh, patch.positions)) EXPECT_NEAR(normal.z, 1.0, 1e-14);
  const auto areas = vertex_areas(patch.mesh, patch.positions);
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), total_area(patch.mesh, patch.positions), 1e-12);
}

TEST(Geometry, HingeAnglesArePositiveWhereConvex) {
  const auto box = make_box_at({0, 0, 0}, {1, 1, 1});
  double sum = 0;
  for (double angle : hinge_angles(box.mesh, box.positions)) {
    EXPECT_TRUE(std::abs(angle) < 1e-14 || std::abs(angle - pi / 2) < 1e-14);
    sum += angle;
  }
  EXPECT_NEAR(sum, 12 * pi / 2, 1e-12);
}

TEST(Geometry, SphereConvergesAtSecondOrder) {
  double errors[2];
  for (int i = 0; i < 2; ++i) {
    const auto sphere = make_icosphere(i == 0 ? 4 : 8, 2.0);
    errors[i] = std::abs(enclosed_volume(sphere.mesh, sphere.positions) / (32.0 * pi / 3.0) - 1);
  }
  EXPECT_LT(errors[1], 0.02);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2.0, 0.1);
}

TEST(Geometry, ReportDescribesASphere) {
  const auto report = describe(make_icosphere(5, 1.0));
  EXPECT_TRUE(report.closed);
  EXPECT_TRUE(report.manifold);
  EXPECT_EQ(report.n_components, 1);
  EXPECT_EQ(report.euler_characteristic, 2);
  EXPECT_EQ(report.n_faces, 500);
  EXPECT_GT(report.angle_min, 45);
  EXPECT_LT(report.angle_max, 75);
  EXPECT_NE(format(report).find("closed              yes"), std::string::npos);
}

TEST(Geometry, ReportSeesFansThatMeetInAPoint) {
  const Surface bow_tie{TriangleMesh(5, {{0, 1, 2}, {0, 3, 4}}),
                        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}};
  EXPECT_FALSE(describe(bow_tie).manifold);
}

}  // namespace
}  // namespace pliant
