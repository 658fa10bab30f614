#include "structure/placement.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "core/error.hpp"
#include "core/random_reals.hpp"
#include "mesh/geometry.hpp"
#include "structure/load_surface.hpp"
#include "structure/place_bodies.hpp"
#include "unit/io/temporary_folder.hpp"

namespace pliant {
namespace {
constexpr double pi = std::numbers::pi;

CaseConfig box_of(Vec3 size) {
  CaseConfig config;
  config.box.size = size;
  config.folder = ".";
  return config;
}

BodyConfig spheres(const std::string& name, double radius, int count) {
  BodyConfig body;
  body.name = name;
  body.surface = SphereSurface{1, radius};
  body.placement.count = count;
  return body;
}

double periodic_distance(Vec3 a, Vec3 b, Vec3 size) {
  Vec3 to = b - a;
  for (int d = 0; d < 3; ++d) to[d] -= size[d] * std::round(to[d] / size[d]);
  return norm(to);
}

std::string problem_of(const CaseConfig& config) {
  try {
    place_bodies(config);
  } catch (const InputError& error) { return error.what(); }
  return "";
}

TEST(Rotation, FollowsTheRightHandRuleAndIsExactAtQuarterTurns) {
  EXPECT_EQ(rotation_about({0, 0, 2}, 90) * Vec3({1, 2, 3}), (Vec3{-2, 1, 3}));
  EXPECT_EQ(rotation_about({0, 3, 0}, -270) * Vec3({1, 2, 3}), (Vec3{3, 2, -1}));
  EXPECT_EQ(rotation_about({0.5, 0, 0}, 540) * Vec3({1, 2, 3}), (Vec3{1, -2, -3}));
  const Mat3 turn = rotation_about({1, 1, 1}, 120);  // x to y to z
  EXPECT_LT(norm(turn * Vec3{1, 2, 3} - Vec3{3, 1, 2}), 1e-15);
  EXPECT_LT(
      norm(product(rotation_about({1, 2, 3}, 25), rotation_about({1, 2, 3}, -25)) * Vec3{1, 5, 3} - Vec3{1, 5, 3}),
      1e-14);
}

TEST(Placement, TurnsTheSurfaceBeforeItIsPutAtItsCenter) {
  BodyConfig body;
  body.surface = PlateSurface{{2, 1}, 0.2};
  body.rotation = {{0, 1, 0}, 30};
  body.center = {5, 6, 7};
  auto plate = load_shape(body, ".");
  plate.positions = place(plate.positions, given_placement(body));
  const Vec3 normal{std::sin(pi / 6), 0, std::cos(pi / 6)};
  for (const Vec3 n : face_normals(plate.mesh, plate.positions)) EXPECT_LT(norm(n - normal), 1e-13);
  for (const Vec3 x : plate.positions) EXPECT_NEAR(dot(x - body.center, normal), 0, 1e-14);
  EXPECT_TRUE(is_open_surface(body.surface));
}

TEST(RandomReals, AreThoseOfTheStandardsGenerator) {
  // The first number of mt19937_64 with its default seed, 5489, is 14514284786278117030.
  EXPECT_EQ(RandomReals(5489).next(), static_cast<double>(14514284786278117030u >> 11) / 9007199254740992.0);
}

TEST(CopyName, CountsWithEnoughDigits) {
  auto body = spheres("grain", 1, 3);
  EXPECT_EQ(copy_name(body, 0, 3), "grain-0001");
  EXPECT_EQ(copy_name(body, 99998, 100000), "grain-099999");
  body.placement.count.reset();
  EXPECT_EQ(copy_name(body, 0, 1), "grain");
}

TEST(PlaceBodies, RandomCopiesKeepTheirDistanceAcrossPeriodicSidesAndFromWalls) {
  auto config = box_of({3, 2, 2.5});
  config.boundary[4] = config.boundary[5] = WallSide{};
  config.bodies = {spheres("a", 0.1, 400), spheres("b", 0.2, 30)};
  config.bodies[0].placement.gap = 0.03;
  const auto placed = place_bodies(config);
  ASSERT_EQ(placed[0].placements.size(), 400u);
  ASSERT_EQ(placed[1].placements.size(), 30u);
  struct Ball {
    Vec3 center;
    double radius;
    bool first;
  };
  std::vector<Ball> balls;
  for (const auto& p : placed[0].placements) balls.push_back({p.center, 0.1, true});
  for (const auto& p : placed[1].placements) balls.push_back({p.center, 0.2, false});
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const double gap = balls[i].first ? 0.03 : 0.0, away = balls[i].radius + gap;
    EXPECT_GE(balls[i].center.z, away - 1e-12);
    EXPECT_LE(balls[i].center.z, 2.5 - away + 1e-12);
    for (std::size_t j = 0; j < i; ++j) {
      // The first body is placed before the second, whose gap is 0.
      const double least = balls[i].radius + balls[j].radius + gap;
      EXPECT_GE(periodic_distance(balls[i].center, balls[j].center, {3, 2, 1e9}), least * (1 - 1e-12));
    }
  }
}

TEST(PlaceBodies, FollowsTheSeedAndNothingElse) {
  auto config = box_of({1, 1, 1});
  config.bodies = {spheres("a", 0.05, 50)};
  config.bodies[0].placement.orientation = OrientationKind::random;
  const auto first = place_bodies(config), again = place_bodies(config);
  config.bodies[0].placement.seed = 2;
  const auto other = place_bodies(config);
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_EQ(first[0].placements[i].center, again[0].placements[i].center);
    EXPECT_EQ(first[0].placements[i].rotation[1], again[0].placements[i].rotation[1]);
    EXPECT_FALSE(first[0].placements[i].center == other[0].placements[i].center);
  }
}

TEST(PlaceBodies, CopiesFillTheRegionEvenlyAndTurnEveryWay) {
  auto config = box_of({4, 4, 4});
  config.bodies = {spheres("a", 0.01, 4000)};
  config.bodies[0].placement.orientation = OrientationKind::random;
  config.bodies[0].placement.region_lower = Vec3{-1, 0, 1};  // across the periodic side
  config.bodies[0].placement.region_upper = Vec3{1, 4, 2};
  const auto placed = place_bodies(config);
  Vec3 mean, axis;
  double second = 0;
  for (const auto& p : placed[0].placements) {
    Vec3 x = p.center;
    EXPECT_TRUE(x.x <= 1 || x.x >= 3);
    EXPECT_TRUE(x.z >= 1.01 && x.z <= 1.99);
    for (int d = 0; d < 3; ++d) EXPECT_TRUE(x[d] >= 0 && x[d] < 4);
    if (x.x > 2) x.x -= 4;
    mean += x / 4000;
    const Vec3 turned = p.rotation * Vec3{1, 0, 0};
    EXPECT_NEAR(norm(turned), 1, 1e-14);
    axis += turned / 4000;
    second += turned.x * turned.x / 4000;
  }
  // Five standard deviations of the mean of 4000 uniform numbers over 2, 4, 1; of a component on the sphere (1/3), and
  // of its square (4/45).
  EXPECT_NEAR(mean.x, 0, 5 * 2 / std::sqrt(12 * 4000.0));
  EXPECT_NEAR(mean.y, 2, 5 * 4 / std::sqrt(12 * 4000.0));
  EXPECT_NEAR(mean.z, 1.5, 5 * 1 / std::sqrt(12 * 4000.0));
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(axis[d], 0, 5 * std::sqrt(1.0 / 3 / 4000));
  EXPECT_NEAR(second, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / 4000));
}

TEST(PlaceBodies, ManyCopiesReachAVolumeFractionOfThirtyPerCent) {
  auto config = box_of({1, 1, 1});
  const int count = 20000;
  const double radius = std::cbrt(0.30 * 3 / (4 * pi * count));
  config.bodies = {spheres("a", radius, count)};
  EXPECT_EQ(place_bodies(config)[0].placements.size(), static_cast<std::size_t>(count));
}

TEST(PlaceBodies, SaysWhenCopiesFindNoPlace) {
  auto config = box_of({1, 1, 1});
  config.bodies = {spheres("a", 0.2, 100)};
  EXPECT_NE(problem_of(config).find("use fewer copies"), std::string::npos);
  config.bodies = {spheres("a", 0.6, 1)};
  EXPECT_NE(problem_of(config).find("no place is wide enough for along x"), std::string::npos);
}

TEST(PlaceBodies, CopiesStayOffTheSurfacesOfSingleBodiesAndOutOfThem) {
  auto config = box_of({4, 4, 4});
  BodyConfig tube;
  tube.name = "tube";
  tube.surface = CylinderSurface{1.0, 3.0, 0.2, CylinderEnds::open};
  tube.center = {0, 2, 2};  // half of it in the neighbouring image
  config.bodies = {spheres("a", 0.1, 800), tube};
  const auto count_inside = [&](const std::vector<PlacedBody>& placed) {
    int inside = 0;
    for (const auto& p : placed[0].placements) {
      Vec3 x = p.center - tube.center;
      for (int d = 0; d < 3; ++d) x[d] -= 4 * std::round(x[d] / 4);
      const double r = std::hypot(x.x, x.y);
      const bool beside_the_side = std::abs(x.z) < 1.4;
      EXPECT_TRUE(!beside_the_side || r <= 0.9 || r > 1.09) << r;
      inside += r < 1 && std::abs(x.z) < 1.5;
    }
    return inside;
  };
  EXPECT_GT(count_inside(place_bodies(config)), 20);
  std::get<CylinderSurface>(config.bodies[1].surface).ends = CylinderEnds::capped;
  EXPECT_EQ(count_inside(place_bodies(config)), 0);
}

TEST(PlaceBodies, ReadsPositionsFromAFile) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "places.csv") << "# two of them\n x , y, z, ax, ay, az, angle\n1,2,3, 0,0,2, 90\r\n\n"
                                                 "4, 5.5, +6e0, 1, 0, 0, 0\n";
  auto config = box_of({8, 8, 8});
  config.folder = folder.path();
  config.bodies = {spheres("a", 0.5, 1)};
  config.bodies[0].placement.count.reset();
  config.bodies[0].placement.positions = "places.csv";
  config.bodies[0].rotation = {{1, 0, 0}, 90};
  const auto placed = place_bodies(config);
  ASSERT_EQ(placed[0].placements.size(), 2u);
  EXPECT_EQ(placed[0].placements[0].center, (Vec3{1, 2, 3}));
  EXPECT_EQ(placed[0].placements[1].center, (Vec3{4, 5.5, 6}));
  // First the body's rotation, y to z, then the line's, x to y.
  EXPECT_EQ(placed[0].placements[0].rotation * Vec3({1, 0, 0}), (Vec3{0, 1, 0}));
  EXPECT_EQ(placed[0].placements[0].rotation * Vec3({0, 1, 0}), (Vec3{0, 0, 1}));
}

TEST(PlaceBodies, NamesTheLinesOfBadPositions) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "places.csv") << "1,2,3\n1,2\n1,2,x\n1,2,nan\n1,2,3,0,0,0,5\n";
  auto config = box_of({8, 8, 8});
  config.folder = folder.path();
  config.bodies = {spheres("a", 0.5, 1)};
  config.bodies[0].placement.count.reset();
  config.bodies[0].placement.positions = "places.csv";
  const auto problems = problem_of(config);
  for (const char* line : {"csv:2:", "csv:3:", "csv:4:", "csv:5:"})
    EXPECT_NE(problems.find(line), std::string::npos) << line;
  EXPECT_EQ(problems.find("csv:1:"), std::string::npos);
  config.bodies[0].placement.positions = "none.csv";
  EXPECT_NE(problem_of(config).find("cannot be read"), std::string::npos);
}

TEST(PlaceBodies, RefusesNamesThatClashWithThoseOfCopies) {
  auto config = box_of({8, 8, 8});
  BodyConfig single;
  single.name = "a-0002";
  single.surface = SphereSurface{1, 0.1};
  config.bodies = {spheres("a", 0.1, 3), single};
  EXPECT_NE(problem_of(config).find("named a-0002"), std::string::npos);
}

}  // namespace
}  // namespace pliant
