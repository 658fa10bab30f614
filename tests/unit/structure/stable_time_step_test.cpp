#include "structure/stable_time_step.hpp"

#include <gtest/gtest.h>

#include "mesh/shapes/icosphere.hpp"
#include "small_bodies.hpp"
#include "unit/mesh/patches.hpp"

namespace pliant {
namespace {

TEST(LargestFrequency, OfATriangleAndATetrahedronOfSprings) {
  auto tetrahedron = make_plain_body(make_tetrahedron(), 2.0);
  tetrahedron.potentials.add(EdgeSprings::uniform(tetrahedron.mesh, tetrahedron.positions, 5.0, 1.0));
  EXPECT_NEAR(find_largest_frequency(tetrahedron), std::sqrt(4 * 5.0 / 2.0), 1e-4);

  auto triangle =
      make_plain_body({TriangleMesh(3, {{0, 1, 2}}), {{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}}}, 2.0);
  triangle.potentials.add(EdgeSprings::uniform(triangle.mesh, triangle.positions, 5.0, 1.0));
  EXPECT_NEAR(find_largest_frequency(triangle), std::sqrt(3 * 5.0 / 2.0), 1e-4);
}

TEST(LargestFrequency, CountsUnequalMasses) {
  // Springs of rest length 0 make a triangle linear: with one corner held by its mass, the others move against each
  // other.
  auto body = make_plain_body({TriangleMesh(3, {{0, 1, 2}}), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, 1.0);
  body.masses[2] = 1e9;
  body.potentials.add(EdgeSprings::uniform(body.mesh, body.positions, 2.0, 0.0));
  EXPECT_NEAR(find_largest_frequency(body), std::sqrt(3 * 2.0), 1e-4);
}

TEST(LargestFrequency, OfALatticeIsNearSixAndBelowTheGershgorinBound) {
  auto body = make_plain_body(make_lattice_patch(24), 0.5);
  body.potentials.add(EdgeSprings::uniform(body.mesh, body.positions, 3.0, 1.0));
  const double squared = std::pow(find_largest_frequency(body), 2) * 0.5 / 3.0;
  EXPECT_LT(squared, 12);   // Gershgorin
  EXPECT_GT(squared, 5.8);  // 6 k / m for the endless lattice, a little less for a patch
  EXPECT_LT(squared, 6.0);
}

TEST(LargestFrequency, OfHingesOnALatticeIsBelowTheBlochBound) {
  auto body = make_plain_body(make_lattice_patch(24), 0.5);
  body.potentials.add(Bending::about_flat(body.mesh, 3.0));
  const double squared = std::pow(find_largest_frequency(body), 2) * 0.5 / 3.0;
  EXPECT_GT(squared, 34);
  EXPECT_LT(squared, 36.001);  // the largest of a scan over all wave vectors is 36 k / l^2
}

TEST(LargestFrequency, FollowsStiffnessAndMass) {
  const auto frequency = [](double stiffness, double mass) {
    auto body = make_plain_body(make_icosphere(3, 1.0), mass);
    body.potentials.add(EdgeSprings::uniform(body.mesh, body.positions, stiffness, 1.0));
    return find_largest_frequency(body);
  };
  EXPECT_NEAR(frequency(8.0, 1.0) / frequency(2.0, 1.0), 2.0, 1e-6);
  EXPECT_NEAR(frequency(2.0, 9.0) / frequency(2.0, 1.0), 1.0 / 3.0, 1e-6);
}

TEST(StableTimeStep, HasTheLimitsOfNoDragAndOfStrongDrag) {
  EXPECT_DOUBLE_EQ(stable_time_step(4.0, 0.0), 0.5);
  EXPECT_NEAR(stable_time_step(1.0, 1e6), 2e6, 3);  // overdamped: 2 c / (m omega^2)
  EXPECT_TRUE(std::isinf(stable_time_step(0.0, 0.0)));
  EXPECT_EQ(find_largest_frequency(make_plain_body(make_tetrahedron(), 1.0)), 0.0);
}

}  // namespace
}  // namespace pliant
