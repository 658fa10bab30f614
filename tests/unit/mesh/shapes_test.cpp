#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/error.hpp"
#include "mesh/check_mesh.hpp"
#include "mesh/describe.hpp"
#include "mesh/geometry.hpp"
#include "mesh/shapes/box.hpp"
#include "mesh/shapes/cylinder.hpp"
#include "mesh/shapes/disc.hpp"
#include "mesh/shapes/ellipsoid.hpp"
#include "mesh/shapes/plate.hpp"
#include "mesh/shapes/red_cell.hpp"

namespace pliant {
namespace {
constexpr double pi = std::numbers::pi;

std::vector<std::string> problems_of(const Surface& surface, Closure closure) {
  SurfaceData data{"shape", surface.positions, {}, {}, {}};
  data.faces.assign(surface.mesh.vertices_of_face().begin(), surface.mesh.vertices_of_face().end());
  return find_mesh_problems(data, closure);
}

/// Sound, in one piece, with this Euler number, and with no angle below `degrees`.
void expect_good(const Surface& surface, Closure closure, int euler, double degrees) {
  EXPECT_EQ(problems_of(surface, closure), std::vector<std::string>{});
  const auto report = describe(surface);
  EXPECT_EQ(report.n_components, 1);
  EXPECT_TRUE(report.manifold);
  EXPECT_EQ(report.euler_characteristic, euler);
  EXPECT_GE(report.angle_min, degrees);
}

TEST(Shapes, AreSoundAndWellShapedAtOddSizes) {
  for (const double edge : {0.07, 0.13, 0.31, 0.9, 7.0})
    for (const double length : {0.11, 0.45, 0.83, 1.0, 1.7, 3.21}) {
      SCOPED_TRACE(std::to_string(edge) + ", " + std::to_string(length));
      expect_good(make_plate(1.0, length, edge), Closure::open, 1, 26);
      expect_good(make_disc(length, edge), Closure::open, 1, 40);
      expect_good(make_half_disc(length, edge), Closure::open, 1, 40);
      expect_good(make_cylinder(0.5, length, edge, Ends::capped), Closure::closed, 2, 40);
      expect_good(make_cylinder(0.5, length, edge, Ends::open), Closure::open, 0, 40);
      expect_good(make_box({1.0, length, 1.3 * length}, edge), Closure::closed, 2, 26);
    }
}

TEST(Shapes, PlateAndBoxAreExact) {
  for (const double edge : {0.09, 0.2, 0.55}) {
    const auto plate = make_plate(1.3, 0.7, edge);
    EXPECT_NEAR(total_area(plate.mesh, plate.positions), 1.3 * 0.7, 1e-14);
    auto report = describe(plate);
    EXPECT_EQ(report.lower, (Vec3{-0.65, -0.35, 0}));
    EXPECT_EQ(report.upper, (Vec3{0.65, 0.35, 0}));
    for (const Vec3 n : face_normals(plate.mesh, plate.positions)) EXPECT_NEAR(n.z, 1, 1e-15);
    const auto tall = describe(make_plate(0.7, 1.3, edge));
    EXPECT_EQ(tall.upper, (Vec3{0.35, 0.65, 0}));
    EXPECT_NEAR(tall.area, 1.3 * 0.7, 1e-14);

    report = describe(make_box({1.3, 0.7, 0.4}, edge));
    EXPECT_EQ(report.lower, (Vec3{-0.65, -0.35, -0.2}));
    EXPECT_EQ(report.upper, (Vec3{0.65, 0.35, 0.2}));
    EXPECT_NEAR(report.volume, 1.3 * 0.7 * 0.4, 1e-14);
    EXPECT_NEAR(report.area, 2 * (1.3 * 0.7 + 0.7 * 0.4 + 0.4 * 1.3), 1e-13);
  }
}

TEST(Shapes, EdgesOfAFinePlateAreAsLongAsAsked) {
  const auto report = describe(make_plate(1, 2, 0.05));
  EXPECT_NEAR(report.edge_mean, 0.05, 0.05 * 0.02);
  EXPECT_GT(report.angle_min, 34);  // widened ends of the rows: atan(0.6 / (sqrt(3) / 2)) = 34.7 for equilateral faces
}

TEST(Shapes, HalfDiscHasAStraightSideThroughTheOrigin) {
  const auto half = make_half_disc(0.8, 0.1);
  int on_side = 0;
  for (const auto& [a, b] : half.mesh.vertices_of_edge()) {
    const Vec3 x = half.positions[a], y = half.positions[b];
    on_side += x.x == 0 && y.x == 0;
  }
  EXPECT_EQ(on_side, 16);
  double least = 1;
  for (const Vec3 x : half.positions) {
    EXPECT_GE(x.x, 0);
    EXPECT_LE(norm(x), 0.8 + 1e-15);
    least = std::min(least, norm(x));
  }
  EXPECT_EQ(least, 0);
  for (const Vec3 n : face_normals(half.mesh, half.positions)) EXPECT_NEAR(n.z, 1, 1e-15);
}

TEST(Shapes, TubeHasTwoBordersOnTheCircle) {
  const auto tube = make_cylinder(0.5, 2, 0.1, Ends::open);
  EXPECT_EQ(tube.mesh.n_border_edges(), 60);
  for (const Vec3 x : tube.positions) EXPECT_NEAR(std::hypot(x.x, x.y), 0.5, 1e-15);
  const auto report = describe(tube);
  EXPECT_EQ(report.lower.z, -1);
  EXPECT_EQ(report.upper.z, 1);
  EXPECT_GT(report.angle_min, 58);
  // Normals away from the axis.
  const auto normals = face_normals(tube.mesh, tube.positions);
  const auto centroids = face_centroids(tube.mesh, tube.positions);
  for (std::size_t f = 0; f < normals.size(); ++f)
    EXPECT_GT(dot(normals[f], centroids[f] - Vec3{0, 0, centroids[f].z}), 0);
}

/// Twice as many parts cut the error to a quarter; the next term of the error is 4 % at most for these sizes.
void expect_second_order(const std::function<double(int)>& measured, double exact) {
  const double coarse = measured(1) - exact, fine = measured(2) - exact;
  EXPECT_NEAR(coarse / fine, 4, 0.16);
}

TEST(Shapes, AreasAndVolumesConvergeAtSecondOrder) {
  const auto area = [](const Surface& s) { return total_area(s.mesh, s.positions); };
  const auto volume = [](const Surface& s) { return enclosed_volume(s.mesh, s.positions); };
  expect_second_order([&](int n) { return area(make_disc(0.7, 0.1 / n)); }, pi * 0.49);
  expect_second_order([&](int n) { return area(make_half_disc(0.7, 0.1 / n)); }, pi * 0.49 / 2);
  // A side of whole rows, so that both meshes are alike.
  const double height = 14 * 0.7 * 2 * std::sin(pi / 42) * std::sqrt(0.75);
  for (const Ends ends : {Ends::capped, Ends::open})
    expect_second_order([&](int n) { return area(make_cylinder(0.7, height, 0.1 / n, ends)); },
                        2 * pi * 0.7 * height + (ends == Ends::capped ? 2 * pi * 0.49 : 0));
  expect_second_order([&](int n) { return volume(make_cylinder(0.7, height, 0.1 / n, Ends::capped)); },
                      pi * 0.49 * height);
  expect_second_order([&](int n) { return volume(make_ellipsoid(8 * n, {2, 1, 0.5})); }, 4.0 / 3 * pi);
  // Prolate spheroid of aspect ratio 2: 2 pi b^2 (1 + a / (b e) asin e).
  const double e = std::sqrt(0.75);
  expect_second_order(
      [&](int n) {
        return area(make_ellipsoid(8 * n, {2, 1, 1}));
      },
      2 * pi * (1 + 2 / e * std::asin(e)));
}

TEST(Shapes, EllipsoidsKeepGoodAnglesUpToAnAspectRatioOfTwo) {
  for (const Vec3 axes : {Vec3{2, 1, 1}, Vec3{1, 2, 1}, Vec3{1, 1, 2}, Vec3{2, 2, 1}, Vec3{1, 2, 2}, Vec3{2, 1, 1.5}})
    for (const int frequency : {2, 5, 8, 16}) {
      const auto surface = make_ellipsoid(frequency, axes);
      expect_good(surface, Closure::closed, 2, 25);
      for (const Vec3 x : surface.positions)
        EXPECT_NEAR(std::hypot(x.x / axes.x, x.y / axes.y, x.z / axes.z), 1, 1e-14);
    }
}

/// Evans & Fung's cell of radius 3.91 micrometres: 94.1 cubic and 134.1 square micrometres, 0.81 thick in the
/// middle, 2.57 where it is thickest.
TEST(Shapes, RedCellsAreThoseOfEvansAndFung) {
  constexpr double radius = 3.91;
  const auto volume = [](const Surface& s) { return enclosed_volume(s.mesh, s.positions); };
  const auto area = [](const Surface& s) { return total_area(s.mesh, s.positions); };
  // The integral of 2 pi r times the thickness, by substitution.
  const double exact = 2 * pi * radius * radius * radius * (0.207 / 3 + 2.003 * 2 / 15 - 1.123 * 8 / 105);
  EXPECT_NEAR(exact, 94.1, 0.05);
  expect_second_order([&](int n) { return volume(make_red_cell(8 * n, radius)); }, exact);
  // The surface of revolution, as narrow frustums.
  const auto half_thickness = [](double r) {
    const double q2 = r * r / (radius * radius);
    return 0.5 * radius * std::sqrt(std::max(0.0, 1 - q2)) * (0.207 + q2 * (2.003 - 1.123 * q2));
  };
  double exact_area = 0;
  constexpr int rings = 100000;
  for (int i = 0; i < rings; ++i) {
    const double inner = radius * std::sin(0.5 * pi * i / rings), outer = radius * std::sin(0.5 * pi * (i + 1) / rings);
    exact_area += 2 * pi * (inner + outer) * std::hypot(outer - inner, half_thickness(outer) - half_thickness(inner));
  }
  EXPECT_NEAR(exact_area, 134.1, 0.05);
  expect_second_order([&](int n) { return area(make_red_cell(8 * n, radius)); }, exact_area);
  for (const int frequency : {2, 5, 8, 16}) {
    const auto cell = make_red_cell(frequency, radius);
    expect_good(cell, Closure::closed, 2, 45);
    double highest = 0, widest = 0;
    for (const Vec3 x : cell.positions) {
      EXPECT_NEAR(std::abs(x.z), half_thickness(std::hypot(x.x, x.y)), 1e-6);
      highest = std::max(highest, x.z);
      widest = std::max(widest, std::hypot(x.x, x.y));
    }
    EXPECT_LE(2 * highest, 2.58);
    if (frequency >= 8) { EXPECT_GT(2 * highest, 2.54); }
    if (frequency % 2 == 0) { EXPECT_NEAR(widest, radius, 1e-6); }
  }
}

TEST(Shapes, RefuseBadSizesAllAtOnce) {
  EXPECT_THROW(make_red_cell(0, 1), InputError);
  EXPECT_THROW(make_red_cell(4, -1), InputError);
  EXPECT_THROW(make_ellipsoid(0, {1, 1, 1}), InputError);
  EXPECT_THROW(make_ellipsoid(4, {1, -1, 1}), InputError);
  EXPECT_THROW(make_disc(1, 1e-5), InputError);
  EXPECT_THROW(make_half_disc(-1, 0.1), InputError);
  EXPECT_THROW(make_cylinder(1, 0, 0.1, Ends::open), InputError);
  EXPECT_THROW(make_box({1, 1, 1e-5}, 0.1), InputError);  // faces as thin as the box would be far too many
  try {
    make_plate(-1, 0, NAN);
    FAIL();
  } catch (const InputError& error) { EXPECT_EQ(error.problems().size(), 3u); }
}

}  // namespace
}  // namespace pliant
