#include "coupling/swing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pliant {
namespace {

// Steps until accelerations are found to swing up; 0: not in `most`.
template <class Acceleration>
int steps_until_found(Acceleration acceleration, double least = 1e-3, int most = 1000) {
  SwingCount swing;
  for (int n = 1; n <= most; ++n)
    if (count_swing(swing, acceleration(n), least)) return n;
  return 0;
}

int steps_of_factor(double factor) {
  return steps_until_found([factor](int n) { return Vec3{1e-6 * std::pow(factor, n), 0, 0}; });
}

TEST(Swing, FindsWhatReversesAndGrows) {
  EXPECT_GT(steps_of_factor(-1.05), 0);
  EXPECT_GT(steps_of_factor(-1.5), 0);
  // One window to compare with, two that grew.
  EXPECT_LE(steps_of_factor(-10), 12);
}

// A leaflet that has swung gently meets its stop, and the fluid at it rings for some steps.
TEST(Swing, HeedsNoImpact) {
  EXPECT_EQ(steps_until_found([](int n) { return Vec3{n < 9 ? -0.1 : 100 * std::pow(-0.5, n - 9), 0, 0}; }), 0);
}

TEST(Swing, HeedsNeitherDecayNorSmoothGrowthNorEvenSwings) {
  EXPECT_EQ(steps_of_factor(-0.9), 0);
  EXPECT_EQ(steps_of_factor(-1), 0);
  EXPECT_EQ(steps_of_factor(1.01), 0);
}

TEST(Swing, HeedsNoNoiseHoweverLarge) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  EXPECT_EQ(steps_until_found(
                [&](int) {
                  return Vec3{normal(random), normal(random), normal(random)};
                },
                1e-3, 100000),
            0);
  EXPECT_EQ(steps_until_found([&](int) { return Vec3{0, normal(random), 0}; }, 1e-3, 100000), 0);
  // Nor that which grows with the flow, while it is small beside the steps of the grid.
  EXPECT_EQ(steps_until_found([&](int n) { return Vec3{0, 1e-12 * n * normal(random), 0}; }), 0);
}

// A stop that the body is thrown against every third step, and rests on.
TEST(Swing, FindsSwingsThatAreCutShort) {
  EXPECT_GT(steps_until_found([](int n) {
              const double size = std::pow(1.4, n);
              return Vec3{n % 3 == 0 ? -size : n % 3 == 1 ? 0.2 * size : 0.3 * size, 0, 0};
            }),
            0);
}

}  // namespace
}  // namespace pliant
