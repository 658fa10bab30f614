#include "coupling/local_mass.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>

#include "structure/stable_time_step.hpp"

namespace pliant {
namespace {

constexpr std::array<double, 3> alphas{8.0 / 15, 2.0 / 15, 1.0 / 3};

TEST(LocalMassSubsteps, HaveOneLengthAndAreStable) {
  for (double limit : {1e-4, 1e-3, 3.3e-3, 0.01, 0.1, 10.0}) {
    const double step = 0.01, length = alphas[0] * step / local_mass_substeps(alphas[0], step, limit, "flag");
    EXPECT_LE(length, limit);
    for (double alpha : alphas)
      EXPECT_NEAR(alpha * step / local_mass_substeps(alpha, step, limit, "flag"), length, 1e-12 * length);
  }
}

/// Largest growth of a vibration by a step of the flow: of the eigenvalues of its three substeps, one after another.
double growth(double omega, double step, const std::array<int, 3>& substeps) {
  double a = 1, b = 0, c = 0, d = 1;  // (x, v) after from (x, v) before
  for (std::size_t i = 0; i < alphas.size(); ++i) {
    const double h = alphas[i] * step / substeps[i];
    for (int n = 0; n < substeps[i]; ++n) {
      c -= h * omega * omega * a, d -= h * omega * omega * b;
      a += h * c, b += h * d;
    }
  }
  const std::complex<double> half(0.5 * (a + d)), root = std::sqrt(half * half - 1.0);
  return std::max(std::abs(half + root), std::abs(half - root));
}

TEST(LocalMassSubsteps, NoVibrationUpToTheFastestGrows) {
  const double limit = 1.0;
  for (double step : {1.0, 3.0, 10.0, 31.0}) {
    std::array<int, 3> equal{}, each{};
    for (std::size_t i = 0; i < alphas.size(); ++i) {
      equal[i] = local_mass_substeps(alphas[i], step, limit, "flag");
      each[i] = substeps_for(alphas[i] * step, limit, "flag");
    }
    double largest = 0, of_each = 0;
    for (int k = 1; k <= 2000; ++k) {
      const double omega = 2.0 / limit * k / 2000;
      largest = std::max(largest, growth(omega, step, equal));
      of_each = std::max(of_each, growth(omega, step, each));
    }
    EXPECT_LT(largest, 1 + 1e-6) << step;
    if (step == 3.0) { EXPECT_GT(of_each, 1.05) << "as few as each substep would bear"; }
  }
}

}  // namespace
}  // namespace pliant
