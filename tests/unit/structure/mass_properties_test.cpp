#include "structure/mass_properties.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/error.hpp"
#include "mesh/shapes/icosphere.hpp"
#include "unit/mesh/box_at.hpp"

namespace pliant {
namespace {

constexpr double pi = std::numbers::pi;

Surface make_ellipsoid(int frequency, Vec3 half_axes, Vec3 center) {
  Surface surface = make_icosphere(frequency, 1.0);
  for (Vec3& x : surface.positions) x = center + Vec3{half_axes.x * x.x, half_axes.y * x.y, half_axes.z * x.z};
  return surface;
}

TEST(MassProperties, SolidBoxIsExact) {
  const Vec3 corner{10, -20, 30}, sides{1, 2, 3};
  const auto box = make_box_at(corner, sides);
  const auto body = solid_mass_properties(box.mesh, box.positions, 2.5);
  // Roundings of coordinates of order 30, squared, times the mass.
  constexpr double tolerance = 1e-11;
  EXPECT_NEAR(body.volume, 6, tolerance);
  EXPECT_NEAR(body.mass, 15, tolerance);
  EXPECT_LT(norm(body.centroid - (corner + 0.5 * sides)), tolerance);
  const double expected[3] = {15.0 * (4 + 9) / 12, 15.0 * (1 + 9) / 12, 15.0 * (1 + 4) / 12};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(body.inertia[i][j], i == j ? expected[i] : 0.0, tolerance);
  // About an edge along z, m (a^2 + b^2) / 3, and about the diagonal of the base, m a^2 b^2 / (6 (a^2 + b^2)) + m
  // c^2/3.
  EXPECT_NEAR(inertia_about(body, corner, {0, 0, -7}), 15.0 * (1 + 4) / 3, tolerance);
  EXPECT_NEAR(inertia_about(body, corner, {1, 2, 0}), 15.0 * (4.0 / (6 * 5) + 9.0 / 3), tolerance);
}

TEST(MassProperties, SolidEllipsoidConvergesAtSecondOrder) {
  const Vec3 half_axes{1.0, 0.6, 2.0}, center{5, 5, 5};
  const double mass = 3.0 * 4.0 * pi / 3.0 * 1.2;
  double errors[2];
  for (int i = 0; i < 2; ++i) {
    const auto surface = make_ellipsoid(i == 0 ? 8 : 16, half_axes, center);
    const auto body = solid_mass_properties(surface.mesh, surface.positions, 3.0);
    EXPECT_LT(norm(body.centroid - center), 1e-12);
    double largest = 0;
    for (int d = 0; d < 3; ++d) {
      const double b = half_axes[(d + 1) % 3], c = half_axes[(d + 2) % 3];
      largest = std::max(largest, std::abs(body.inertia[d][d] / (mass / 5 * (b * b + c * c)) - 1));
    }
    errors[i] = largest;
  }
  EXPECT_LT(errors[1], 0.01);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2.0, 0.05);
}

TEST(MassProperties, SphericalShellConvergesAtSecondOrder) {
  const double radius = 1.5, mass = 2.0 * 0.01 * 4 * pi * radius * radius;
  double errors[2];
  for (int i = 0; i < 2; ++i) {
    const auto sphere = make_icosphere(i == 0 ? 8 : 16, radius);
    const auto body = shell_mass_properties(sphere.mesh, sphere.positions, 2.0, 0.01);
    EXPECT_NEAR(body.volume, body.mass / 2.0, 1e-15);
    errors[i] = std::abs(body.inertia[1].y / (2.0 / 3.0 * mass * radius * radius) - 1);
  }
  EXPECT_LT(errors[1], 0.01);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2.0, 0.05);
}

TEST(MassProperties, OpenPlateIsExact) {
  // A rectangle 2 x 3 in a plane of constant x, cut into four uneven triangles.
  const TriangleMesh mesh(5, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  const std::vector<Vec3> positions{{7, 0, 0}, {7, 2, 0}, {7, 2, 3}, {7, 0, 3}, {7, 0.3, 1.1}};
  const auto plate = shell_mass_properties(mesh, positions, 4.0, 0.05);
  const double mass = 4.0 * 0.05 * 6.0;
  EXPECT_NEAR(plate.mass, mass, 1e-14);
  EXPECT_LT(norm(plate.centroid - Vec3{7, 1, 1.5}), 1e-14);
  const double expected[3] = {mass * (4 + 9) / 12, mass * 9 / 12, mass * 4 / 12};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(plate.inertia[i][j], i == j ? expected[i] : 0.0, 1e-13);
  // A leaflet on a hinge along its side y = 0.
  EXPECT_NEAR(inertia_about(plate, {7, 0, -1}, {0, 0, 1}), mass * 4 / 3, 1e-13);
}

TEST(MassProperties, RefusesWhatHasNoMass) {
  const TriangleMesh mesh(3, {{0, 1, 2}});
  const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const auto problems_of = [](auto&& call) {
    try {
      call();
    } catch (const InputError& error) { return error.problems().size(); }
    return std::size_t{0};
  };
  EXPECT_EQ(problems_of([&] { solid_mass_properties(mesh, positions, -1.0); }), 2u);
  EXPECT_EQ(problems_of([&] { shell_mass_properties(mesh, positions, 0.0, std::nan("")); }), 2u);
  EXPECT_EQ(problems_of([&] { shell_mass_properties(mesh, positions, 1.0, 0.1); }), 0u);
  // Turned inside out.
  auto box = make_box_at({0, 0, 0}, {1, 1, 1});
  for (Vec3& x : box.positions) x = -x;
  EXPECT_EQ(problems_of([&] { solid_mass_properties(box.mesh, box.positions, 1.0); }), 1u);
}

}  // namespace
}  // namespace pliant
