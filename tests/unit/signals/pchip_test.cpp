#include "signals/pchip.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace pliant {
namespace {

using Points = std::vector<std::array<double, 2>>;

Points random_points(std::uint64_t seed, int count) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1.0p-53; };
  Points points;
  double t = -1;
  for (int n = 0; n < count; ++n) {
    points.push_back({t, 4 * uniform() - 2});
    t += 0.05 + uniform();
  }
  return points;
}

TEST(Pchip, PassesThroughItsPoints) {
  const auto points = random_points(1, 20);
  const Pchip curve(points);
  for (const auto& [t, v] : points) EXPECT_EQ(curve.value(t), v);
}

TEST(Pchip, StaysBetweenItsPoints) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const auto points = random_points(seed, 12);
    const Pchip curve(points);
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      const auto [low, high] = std::minmax(points[k][1], points[k + 1][1]);
      double last = points[k][1];
      for (int n = 0; n <= 100; ++n) {
        const double v = curve.value(points[k][0] + (points[k + 1][0] - points[k][0]) * n / 100);
        EXPECT_GE(v, low - 1e-14);
        EXPECT_LE(v, high + 1e-14);
        EXPECT_GE((v - last) * (points[k + 1][1] - points[k][1]), -1e-14) << "monotone between two points";
        last = v;
      }
    }
  }
}

TEST(Pchip, IsExactForStraightLines) {
  Points points;
  for (double t : {0.0, 0.1, 0.5, 0.55, 2.0}) points.push_back({t, 3 - 2 * t});
  const Pchip curve(points);
  for (double t = 0; t <= 2; t += 0.01) EXPECT_NEAR(curve.value(t), 3 - 2 * t, 1e-14);
}

TEST(Pchip, KeepsTheEndsOutside) {
  const Pchip curve(Points{{1, 5}, {2, -3}, {4, 0}});
  EXPECT_EQ(curve.value(-100), 5);
  EXPECT_EQ(curve.value(1e9), 0);
  EXPECT_EQ(Pchip(Points{{1, 7}}).value(0.3), 7);
}

TEST(Pchip, HasAContinuousDerivative) {
  for (bool periodic : {false, true}) {
    const auto points = random_points(3, 10);
    const double length = points.back()[0] - points.front()[0];
    const Pchip curve = periodic ? Pchip(points, length + 0.4) : Pchip(points);
    constexpr double h = 1e-6;
    const auto jump = [&](double t) {
      return std::abs((curve.value(t + h) - curve.value(t)) - (curve.value(t) - curve.value(t - h))) / h;
    };
    // What remains is the second derivative times h, at most some hundreds here.
    for (std::size_t k = 1; k + 1 < points.size(); ++k) EXPECT_LT(jump(points[k][0]), 1e-3);
    if (!periodic) continue;
    EXPECT_LT(jump(points.front()[0]), 1e-3);
    EXPECT_LT(jump(points.back()[0]), 1e-3);
    for (double t = -3; t < 3; t += 0.0701) EXPECT_NEAR(curve.value(t), curve.value(t + 5 * (length + 0.4)), 1e-12);
  }
}

TEST(Pchip, ClosesTheCircleWhenTheTableIsAsLongAsThePeriod) {
  const Pchip open(Points{{0, 1}, {0.3, 2}, {0.6, -1}}, 1.0), closed(Points{{0, 1}, {0.3, 2}, {0.6, -1}, {1, 1}}, 1.0);
  for (double t = -1; t < 2; t += 0.013) EXPECT_EQ(open.value(t), closed.value(t));
}

TEST(Pchip, ConvergesForSmoothCurves) {
  using std::numbers::pi;
  const auto error = [](int n) {
    Points points;
    for (int k = 0; k < n; ++k) points.push_back({1.0 * k / n, std::sin(2 * pi * k / n)});
    const Pchip curve(points, 1.0);
    double worst = 0;
    for (int k = 0; k < 1000; ++k)
      worst = std::max(worst, std::abs(curve.value(k / 1000.0) - std::sin(2 * pi * k / 1000)));
    return worst;
  };
  EXPECT_GT(error(20) / error(40), 3.5) << "at least of second order: it is of first order in slope at extrema";
}

TEST(Wrap, StaysWithinThePeriod) {
  for (double t : {-1e-18, 0.0, 0.3, 1.0, 7.3, -2.0, 1e17, -1e17}) {
    const double rest = wrap(t, 0.3);
    EXPECT_GE(rest, 0);
    EXPECT_LT(rest, 0.3);
  }
}

}  // namespace
}  // namespace pliant
