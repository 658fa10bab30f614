#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "solvers/plane_helmholtz.hpp"
#include "solvers/row_helmholtz.hpp"

// The residual of (1 - a d2) x = d, written out again here, must vanish to round-off for every kind of end, odd and
// even lengths, and a from nothing to very large.
namespace pliant {
namespace {

struct Case {
  int n;
  double a;
  LineEnds ends;
  double low, high;
};

double residual(const Case& c, const std::vector<double>& x, const std::vector<double>& d) {
  double worst = 0, scale = 0;
  for (int i = 0; i < c.n; ++i) {
    const auto at = [&](int j) {
      if (j >= 0 && j < c.n) return x[static_cast<std::size_t>(j)];
      if (c.ends == LineEnds::periodic) return x[static_cast<std::size_t>((j + c.n) % c.n)];
      return j < 0 ? c.low * x[0] : c.high * x[static_cast<std::size_t>(c.n) - 1];
    };
    worst =
        std::max(worst, std::abs(at(i) - c.a * (at(i + 1) - 2 * at(i) + at(i - 1)) - d[static_cast<std::size_t>(i)]));
    scale = std::max(scale, (1 + 4 * c.a) * std::abs(at(i)));
  }
  return worst / scale;
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (int n : {1, 2, 3, 7, 8, 9, 16, 31, 64, 257})
    for (double a : {0.0, 1e-12, 1e-3, 0.3, 10.0, 1e4}) {
      all.push_back({n, a, LineEnds::periodic, 0, 0});
      for (double low : {-1.0, 0.0, 1.0})
        for (double high : {-1.0, 0.0, 1.0}) all.push_back({n, a, LineEnds::bounded, low, high});
    }
  return all;
}

std::vector<double> right_hand_side(int n) {
  std::vector<double> d;
  for (int i = 0; i < n; ++i) d.push_back(std::sin(1.7 * i) + 0.3 * std::cos(0.1 * i * i));
  return d;
}

TEST(RowHelmholtz, SolvesEveryKindOfEnd) {
  for (const Case& c : cases()) {
    const auto d = right_hand_side(c.n);
    auto x = d;
    RowHelmholtz(c.n, c.a, c.ends, c.low, c.high).solve(x.data());
    // The free solution of a line with both gradients zero is fixed by a sum over the line: its condition is that of a.
    const double bound = 1e-14 * std::max(1.0, std::sqrt(c.a));
    EXPECT_LT(residual(c, x, d), bound) << "n " << c.n << " a " << c.a << " low " << c.low << " high " << c.high;
  }
}

TEST(PlaneHelmholtz, SolvesEveryColumnLikeARow) {
  constexpr int width = 5, stride = 7;
  for (const Case& c : cases()) {
    std::vector<double> plane(static_cast<std::size_t>(c.n) * stride), work(2 * width);
    const auto d = right_hand_side(c.n);
    for (int j = 0; j < c.n; ++j)
      for (int i = 0; i < width; ++i)
        plane[static_cast<std::size_t>(j * stride + i)] = (i + 1) * d[static_cast<std::size_t>(j)];
    PlaneHelmholtz(c.n, c.a, c.ends, c.low, c.high).solve(plane.data(), width, stride, work.data());
    for (int i = 0; i < width; ++i) {
      std::vector<double> x, scaled;
      for (int j = 0; j < c.n; ++j) {
        x.push_back(plane[static_cast<std::size_t>(j * stride + i)]);
        scaled.push_back((i + 1) * d[static_cast<std::size_t>(j)]);
      }
      EXPECT_LT(residual(c, x, scaled), 1e-14) << "n " << c.n << " a " << c.a << " low " << c.low << " high " << c.high;
    }
  }
}

}  // namespace
}  // namespace pliant
