#include "diagnostics/shape.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "mesh/shapes/icosphere.hpp"
#include "mesh/shapes/plate.hpp"

namespace pliant {
namespace {

constexpr double degrees = std::numbers::pi / 180.0;

/// The unit sphere stretched to (a, b, c), turned by an angle from x towards z, moved off the origin.
EllipsoidFit fit_of(int frequency, Vec3 axes, double angle) {
  auto sphere = make_icosphere(frequency, 1.0);
  for (Vec3& x : sphere.positions) {
    const Vec3 s{axes.x * x.x, axes.y * x.y, axes.z * x.z};
    const double c = std::cos(angle * degrees), n = std::sin(angle * degrees);
    x = Vec3{c * s.x - n * s.z, s.y, n * s.x + c * s.z} + Vec3{10, -20, 30};
  }
  return fit_ellipsoid(sphere.mesh, sphere.positions);
}

TEST(EllipsoidFit, FindsAxesAngleVolumeAndCentreAtSecondOrder) {
  const Vec3 axes{1.4, 1.0, 0.7};
  double errors[2];
  for (int i = 0; i < 2; ++i) {
    const auto fit = fit_of(8 << i, axes, 27.0);
    errors[i] = std::abs(fit.length - axes.x);
    EXPECT_NEAR(fit.length, axes.x, 0.006);
    EXPECT_NEAR(fit.width, axes.y, 0.006);
    EXPECT_NEAR(fit.breadth, axes.z, 0.006);
    EXPECT_NEAR(fit.angle, 27.0, 0.05);
    EXPECT_NEAR(fit.volume, 4.0 / 3.0 * std::numbers::pi * 0.98, 0.06);
    EXPECT_LT(norm(fit.centroid - Vec3{10, -20, 30}), 1e-12);
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2.0, 0.1);
}

TEST(EllipsoidFit, TellsTheWidthByItsDirectionNotItsSize) {
  for (double width : {2.0, 0.95, 0.3}) {
    const auto fit = fit_of(8, {1.2, width, 0.9}, -60.0);
    EXPECT_NEAR(fit.width, width, 0.01 * width);
    EXPECT_NEAR(fit.length, 1.2, 0.01);
    EXPECT_NEAR(fit.breadth, 0.9, 0.01);
    EXPECT_NEAR(fit.angle, -60.0, 0.1);
  }
}

TEST(EllipsoidFit, UprightIsNinetyDegrees) { EXPECT_NEAR(std::abs(fit_of(8, {1.5, 1, 0.8}, 90.0).angle), 90.0, 0.05); }

TEST(EllipsoidFit, OfASphereIsASphere) {
  const auto fit = fit_of(8, {1, 1, 1}, 0.0);
  EXPECT_NEAR(fit.length, fit.breadth, 1e-12);
  EXPECT_NEAR(fit.width, fit.breadth, 1e-12);
}

TEST(MeasureShape, OfAnOpenSurfaceHasItsCentroidAndAttachments) {
  const auto plate = make_plate(2.0, 1.0, 0.2);
  DeformableBody body;
  body.mesh = plate.mesh;
  body.positions = body.reference = plate.positions;
  for (Vec3& x : body.positions) x += Vec3{1, 2, 3};
  body.velocities.resize(body.positions.size());
  body.masses.assign(body.positions.size(), 1.0);
  EXPECT_TRUE(measure_shape(body).energies.empty());
  body.attachments.tethers = std::make_shared<const std::vector<Tether>>(1, Tether{0, plate.positions[0], 2.0, 0});
  const auto shape = measure_shape(body);
  EXPECT_LT(norm(shape.ellipsoid.centroid - Vec3{1, 2, 3}), 1e-12);
  EXPECT_NEAR(shape.area, 2.0, 1e-12);
  EXPECT_EQ(shape.ellipsoid.volume, 0);
  EXPECT_TRUE(std::isnan(shape.ellipsoid.length));
  ASSERT_EQ(shape.energies.size(), 1u);
  EXPECT_NEAR(shape.energies[0].second, 0.5 * 2.0 * 14.0, 1e-12);
}

}  // namespace
}  // namespace pliant
