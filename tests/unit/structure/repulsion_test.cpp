#include "structure/repulsion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "core/error.hpp"
#include "mesh/geometry.hpp"
#include "mesh/shapes/icosphere.hpp"

namespace pliant {
namespace {

using Points = std::vector<SurfacePoint>;
constexpr auto open = RepulsionSide::open, wall = RepulsionSide::wall, periodic = RepulsionSide::periodic;

Points random_points(int n, const RepulsionBox& box, int n_bodies) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  Points points;
  for (int i = 0; i < n; ++i) {
    Vec3 x;
    for (int d = 0; d < 3; ++d) x[d] = box.origin[d] + box.size[d] * uniform(engine);
    points.push_back({x, 0.5 + uniform(engine), i % n_bodies});
  }
  return points;
}

std::vector<Vec3> forces_of(const Points& points, const RepulsionBox& box, const Repulsion& repulsion) {
  std::vector<Vec3> forces(points.size());
  add_repulsion(points, points.size(), box, repulsion, forces);
  return forces;
}

/// Sum over all pairs, nearest image.
std::vector<Vec3> slow_forces(const Points& points, const RepulsionBox& box, const Repulsion& repulsion) {
  std::vector<Vec3> forces(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (points[i].body == points[j].body) continue;
      Vec3 nearest = points[i].position - points[j].position;
      for (int d = 0; d < 3; ++d)
        if (box.sides[2 * d] == periodic)
          for (double shift : {-2 * box.size[d], -box.size[d], box.size[d], 2 * box.size[d]}) {
            const double moved = points[i].position[d] - points[j].position[d] + shift;
            if (std::abs(moved) < std::abs(nearest[d])) nearest[d] = moved;
          }
      const double distance = norm(nearest);
      forces[i] += repulsion.strength * points[i].area * points[j].area / std::pow(repulsion.range, 2) *
                   repulsion_weight(distance / repulsion.range) / distance * nearest;
    }
  return forces;
}

double largest_of(const std::vector<Vec3>& vectors) {
  double largest = 0;
  for (const Vec3& v : vectors) largest = std::max(largest, norm(v));
  return largest;
}

TEST(Repulsion, WeightIsMinusTheSlopeOfThePotential) {
  const double h = 1e-5;
  for (double s : {0.001, 0.05, 0.1, 0.3, 0.7, 0.95}) {
    const double slope = (repulsion_potential(s + h) - repulsion_potential(s - h)) / (2 * h);
    EXPECT_NEAR(repulsion_weight(s), -slope, 1e-5 * (1 + repulsion_weight(s)));  // h^2/6 w'', w'' up to 1e4
  }
  EXPECT_EQ(repulsion_weight(1.0), 0);
  EXPECT_EQ(repulsion_potential(1.0), 0);
  EXPECT_LT(repulsion_potential(1 - 1e-4), 1e-12);  // third order at the range
}

TEST(Repulsion, StrengthIsTheGreatestPressureBetweenParallelSurfaces) {
  const auto pressure = [](double gap) {
    const int n = 20000;
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += repulsion_weight(gap + (i + 0.5) * (1 - gap) / n) * (1 - gap) / n;
    return 2 * std::numbers::pi * gap * sum;
  };
  double greatest = 0, at = 0;
  for (double gap = 0.05; gap < 0.5; gap += 0.001)
    if (pressure(gap) > greatest) greatest = pressure(at = gap);
  EXPECT_NEAR(greatest, 1.0, 1e-5);  // a maximum seen on steps of 0.001
  EXPECT_NEAR(at, 0.111, 0.001);
}

TEST(Repulsion, MatchesTheSumOverAllPairs) {
  const Repulsion repulsion{2.0, 0.3};
  // Odd sizes; a direction of only two ranges, one of less than one.
  for (const RepulsionBox& box :
       {RepulsionBox{{-1, 2, 0.3}, {1.37, 0.6, 2.11}, {periodic, periodic, open, open, periodic, periodic}},
        RepulsionBox{{0, 0, 0}, {0.71, 1.9, 0.2}, {periodic, periodic, open, open, open, open}}}) {
    const Points points = random_points(400, box, 5);
    const auto fast = forces_of(points, box, repulsion), slow = slow_forces(points, box, repulsion);
    const double scale = largest_of(slow);
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT(norm(fast[i] - slow[i]), 1e-13 * scale);
  }
}

TEST(Repulsion, PairForcesAreOppositeToTheBit) {
  const RepulsionBox box{{0, 0, 0}, {1, 1, 1}, {periodic, periodic, periodic, periodic, open, open}};
  const Repulsion repulsion{3.0, 0.41};
  int n_near = 0;
  const Points some = random_points(60, box, 60);
  for (const auto& a : some)
    for (const auto& b : some) {
      if (a.body == b.body) continue;
      const auto forces = forces_of({a, b}, box, repulsion);
      EXPECT_EQ(forces[0], -forces[1]);
      n_near += norm(forces[0]) > 0;
    }
  EXPECT_GT(n_near, 100);
}

TEST(Repulsion, NetForceAndTorqueVanish) {
  const RepulsionBox box{{0, 0, 0}, {1, 1.3, 0.7}, {}};
  const Points points = random_points(500, box, 3);
  const auto forces = forces_of(points, box, {1.0, 0.25});
  Vec3 force, torque;
  double sum_of_sizes = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    force += forces[i];
    torque += cross(points[i].position, forces[i]);
    sum_of_sizes += norm(forces[i]);
  }
  EXPECT_LT(norm(force), 1e-13 * sum_of_sizes);
  EXPECT_LT(norm(torque), 1e-13 * sum_of_sizes);
}

TEST(Repulsion, IsMinusTheGradientOfItsEnergy) {
  const RepulsionBox box{{0, 0, 0}, {1, 0.9, 0.8}, {periodic, periodic, wall, wall, open, wall}};
  const Repulsion repulsion{2.0, 0.3};
  Points points = random_points(120, box, 4);
  points[5].position.y = -0.05;  // behind a wall
  const auto forces = forces_of(points, box, repulsion);
  const double h = 1e-6, scale = largest_of(forces);
  for (std::size_t i = 0; i < points.size(); i += 5)
    for (int d = 0; d < 3; ++d) {
      Points moved = points;
      moved[i].position[d] += h;
      const double ahead = repulsion_energy(moved, moved.size(), box, repulsion);
      moved[i].position[d] -= 2 * h;
      const double behind = repulsion_energy(moved, moved.size(), box, repulsion);
      // Roundings of the whole energy over 2 h, and h^2 times the curvature of the force.
      EXPECT_NEAR(forces[i][d], (behind - ahead) / (2 * h), 1e-7 * scale);
    }
}

TEST(Repulsion, DoesNotDependOnNumberingNorOnWhoOwnsThePoints) {
  const RepulsionBox box{{0, 0, 0}, {1, 0.9, 0.8}, {periodic, periodic, wall, wall, open, open}};
  const Repulsion repulsion{2.0, 0.3};
  const Points points = random_points(300, box, 7);
  const auto expected = forces_of(points, box, repulsion);
  const double energy = repulsion_energy(points, points.size(), box, repulsion);

  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  // Three owners, each with the others' points behind its own.
  double energies = 0;
  for (std::size_t owner = 0; owner < 3; ++owner) {
    std::vector<std::size_t> own, all;
    for (std::size_t i : order) (i % 3 == owner ? own : all).push_back(i);
    all.insert(all.begin(), own.begin(), own.end());
    Points local;
    for (std::size_t i : all) local.push_back(points[i]);
    std::vector<Vec3> forces(own.size());
    add_repulsion(local, own.size(), box, repulsion, forces);
    energies += repulsion_energy(local, own.size(), box, repulsion);
    for (std::size_t i = 0; i < own.size(); ++i) EXPECT_EQ(forces[i], expected[own[i]]);
  }
  EXPECT_NEAR(energies, energy, 1e-12 * energy);
}

TEST(Repulsion, ActsAcrossPeriodicSidesAndOnAnyImage) {
  const RepulsionBox box{{0, 0, 0}, {1, 1, 1}, {periodic, periodic, open, open, periodic, periodic}};
  const Repulsion repulsion{1.0, 0.2};
  const auto inside = forces_of({{{0.45, 0.5, 0.5}, 1, 0}, {{0.55, 0.5, 0.5}, 1, 1}}, box, repulsion);
  const auto across = forces_of({{{0.95, 0.5, 0.5}, 1, 0}, {{0.05, 0.5, 0.5}, 1, 1}}, box, repulsion);
  const auto image = forces_of({{{-2.05, 0.5, 0.5}, 1, 0}, {{4.05, 0.5, 1.5}, 1, 1}}, box, repulsion);
  EXPECT_LT(inside[0].x, 0);
  // Roundings of coordinates of up to 4 over a distance of 0.1.
  EXPECT_NEAR(across[0].x, inside[0].x, 1e-13 * std::abs(inside[0].x));
  EXPECT_NEAR(image[0].x, inside[0].x, 1e-13 * std::abs(inside[0].x));
}

TEST(Repulsion, WallsPushInwardsAlsoFromBehind) {
  const RepulsionBox box{{1, 0, 0}, {1, 2, 2}, {wall, wall, open, open, open, open}};
  const auto force_at = [&](double x) { return forces_of({{{x, 1, 1}, 0.5, 0}}, box, {8.0, 0.2})[0]; };
  EXPECT_EQ(force_at(1.5), Vec3{});
  EXPECT_NEAR(force_at(1.1).x, 4.0 * 0.25, 1e-14);
  EXPECT_NEAR(force_at(1.0).x, 4.0, 1e-14);
  EXPECT_NEAR(force_at(0.9).x, 4.0 * 2.25, 1e-13);
  EXPECT_NEAR(force_at(1.9).x, -4.0 * 0.25, 1e-14);
  EXPECT_EQ(force_at(1.9).y, 0.0);
}

/// Force along x between two unit spheres with a gap of half a range of 0.4.
double force_between_spheres(int frequency) {
  const auto sphere = make_icosphere(frequency, 1.0);
  const auto centroids = face_centroids(sphere.mesh, sphere.positions);
  const auto areas = face_areas(sphere.mesh, sphere.positions);
  Points points;
  for (int body = 0; body < 2; ++body)
    for (std::size_t f = 0; f < areas.size(); ++f) {
      // The second sphere is turned, so that faces do not look at their like.
      const Vec3 x = centroids[f];
      const Vec3 turned = body == 0 ? x : Vec3{x.y, x.z, x.x};
      points.push_back({turned + Vec3{body * 2.2, 0, 0}, areas[f], body});
    }
  const auto forces = forces_of(points, {{-1, -1, -1}, {4.2, 2, 2}, {}}, {1.0, 0.4});
  double sum = 0;
  for (std::size_t i = 0; i < areas.size(); ++i) sum += forces[i].x;
  return sum;
}

TEST(Repulsion, ConvergesWithTheMesh) {
  const double a = force_between_spheres(8), b = force_between_spheres(16), c = force_between_spheres(32);
  EXPECT_LT(c, 0);
  // The polyhedra approach the spheres at second order, and the sums the integrals.
  EXPECT_NEAR(std::log2((a - b) / (b - c)), 2.0, 0.3);
}

TEST(Repulsion, FineSheetPressesWithItsStrength) {
  // A sheet of squares of 0.05 ranges, wider than the range, and a point above it at the gap of greatest pressure.
  const double range = 0.3, spacing = 0.05 * range;
  const int half = 25;
  Points points{{{0.003, 0.001, 0.111 * range}, 0.02, 1}};
  for (int i = -half; i <= half; ++i)
    for (int j = -half; j <= half; ++j) points.push_back({{i * spacing, j * spacing, 0}, spacing * spacing, 0});
  const auto forces = forces_of(points, {{-1, -1, -1}, {2, 2, 2}, {}}, {5.0, range});
  EXPECT_NEAR(forces[0].z, 5.0 * 0.02, 1e-3 * 5.0 * 0.02);  // (spacing / gap)^2 of what varies over a square
  EXPECT_LT(std::hypot(forces[0].x, forces[0].y), 1e-3 * 5.0 * 0.02);
}

TEST(Repulsion, LeavesBrokenPointsOut) {
  const RepulsionBox box{{0, 0, 0}, {1, 1, 1}, {periodic, periodic, wall, wall, open, open}};
  Points points = random_points(50, box, 3);
  const auto expected = forces_of(points, box, {1.0, 0.3});
  points.push_back({{std::nan(""), 0.5, 0.5}, 1, 3});
  points.push_back({{HUGE_VAL, 0.5, 0.5}, 1, 4});
  const auto forces = forces_of(points, box, {1.0, 0.3});
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(forces[i], expected[i]);
}

TEST(Repulsion, RefusesARangeThatSeesItsOwnImage) {
  const RepulsionBox box{{0, 0, 0}, {1, 1, 1}, {periodic, periodic, open, open, open, open}};
  std::vector<Vec3> forces;
  EXPECT_THROW(add_repulsion({}, 0, box, {1.0, 0.51}, forces), InputError);
  EXPECT_THROW(add_repulsion({}, 0, box, {1.0, 0.0}, forces), InputError);
  EXPECT_NO_THROW(add_repulsion({}, 0, box, {1.0, 0.5}, forces));
}

}  // namespace
}  // namespace pliant
