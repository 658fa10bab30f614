#include "mesh/lids.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesh/geometry.hpp"
#include "mesh/shapes/cylinder.hpp"
#include "mesh/shapes/icosphere.hpp"
#include "mesh/shapes/plate.hpp"

namespace pliant {
namespace {

std::vector<Vec3> random_vectors(std::size_t n, double size) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-size, size);
  std::vector<Vec3> vectors(n);
  for (Vec3& v : vectors) v = {number(random), number(random), number(random)};
  return vectors;
}

VolumeAndRate measure(const Surface& surface, const std::vector<Vec3>& velocities) {
  const LiddedSurface lidded(surface.mesh);
  return enclosed_volume_and_rate(lidded.faces(), lidded.with_hubs(surface.positions), lidded.with_hubs(velocities));
}

TEST(LiddedSurface, ClosesATubeToThePrismThatItIs) {
  const auto tube = make_cylinder(0.7, 2.0, 0.2, Ends::open), whole = make_cylinder(0.7, 2.0, 0.2, Ends::capped);
  ASSERT_FALSE(tube.mesh.is_closed());
  const LiddedSurface lidded(tube.mesh);
  EXPECT_EQ(lidded.n_lids(), 2);
  EXPECT_TRUE(TriangleMesh(tube.mesh.n_vertices() + 2, {lidded.faces().begin(), lidded.faces().end()}).is_closed());
  const double expected = enclosed_volume(whole.mesh, whole.positions);
  EXPECT_NEAR(measure(tube, tube.positions).volume, expected, 1e-13);
  // In the flow x -> A x a volume grows at the rate trace(A) V.
  std::vector<Vec3> velocities;
  for (const Vec3& x : tube.positions) velocities.push_back({0.3 * x.x + x.z, 2 * x.x - 0.7 * x.y, x.y + 1.1 * x.z});
  EXPECT_NEAR(measure(tube, velocities).rate, 0.7 * expected, 1e-13);
}

TEST(LiddedSurface, LeavesAClosedSurfaceAsItIs) {
  const auto ball = make_icosphere(5, 1.3);
  EXPECT_EQ(LiddedSurface(ball.mesh).n_lids(), 0);
  EXPECT_NEAR(measure(ball, ball.positions).volume, enclosed_volume(ball.mesh, ball.positions), 1e-13);
  EXPECT_NEAR(measure(ball, ball.positions).rate, 3 * enclosed_volume(ball.mesh, ball.positions), 1e-12);
}

TEST(LiddedSurface, ASheetWithItsLidEnclosesNothing) {
  const auto plate = make_plate(1, 2, 0.25);
  EXPECT_EQ(LiddedSurface(plate.mesh).n_lids(), 1);
  EXPECT_NEAR(measure(plate, plate.positions).volume, 0, 1e-15);
}

// The volume is a cubic of the vertices, along any line: five points give its slope without error.
TEST(LiddedSurface, RateIsTheDerivativeOfTheVolumeWhateverTheBorders) {
  auto tube = make_cylinder(1.0, 1.5, 0.3, Ends::open);
  const auto rough = random_vectors(tube.positions.size(), 0.2), velocities = random_vectors(tube.positions.size(), 1);
  for (std::size_t v = 0; v < rough.size(); ++v) tube.positions[v] += rough[v];
  const auto volume_at = [&](double t) {
    auto moved = tube;
    for (std::size_t v = 0; v < rough.size(); ++v) moved.positions[v] += t * velocities[v];
    return measure(moved, velocities).volume;
  };
  const double h = 0.1;
  const double slope = (8 * (volume_at(h) - volume_at(-h)) - (volume_at(2 * h) - volume_at(-2 * h))) / (12 * h);
  EXPECT_NEAR(measure(tube, velocities).rate, slope, 1e-12);
}

}  // namespace
}  // namespace pliant
