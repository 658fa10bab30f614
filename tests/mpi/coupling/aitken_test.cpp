#include "coupling/aitken.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "structure/rigid_body.hpp"

namespace pliant {
namespace {

constexpr int n_values = 23;

/// The rank's values of 0 .. n_values - 1: uneven shares, and none for the last of several ranks.
std::vector<int> own_values(const Communicator& ranks) {
  std::vector<int> own;
  const int n_owners = std::max(1, ranks.size() - 1);
  for (int i = 0; i < n_values; ++i)
    if (i * i % n_owners == ranks.rank()) own.push_back(i);
  return own;
}

/// G(x)_i = -slope_i x_i + b_i, whose fixed point is b_i / (1 + slope_i).
struct Map {
  double slope, spread;
  double slope_of(int i) const { return slope + spread * std::sin(2.0 * i); }
  double solution(int i) const { return (1.0 + 0.1 * i) / (1.0 + slope_of(i)); }
  std::vector<double> operator()(const std::vector<int>& own, const std::vector<double>& x) const {
    std::vector<double> image;
    for (std::size_t k = 0; k < own.size(); ++k) image.push_back(1.0 + 0.1 * own[k] - slope_of(own[k]) * x[k]);
    return image;
  }
};

double error_of(const Communicator& ranks, const Map& map, const std::vector<int>& own, const std::vector<double>& x) {
  double error = 0;
  for (std::size_t k = 0; k < own.size(); ++k) error = std::max(error, std::abs(x[k] - map.solution(own[k])));
  return ranks.max(error);
}

TEST(Aitken, OneSlopeTakesTwoSteps) {
  // The residuals of two points give a slope of -3 exactly, and w = 1/(1 + 3).
  const Communicator ranks;
  const auto own = own_values(ranks);
  const Map map{3.0, 0.0};
  AitkenRelaxation relaxation(ranks, 0.5);
  std::vector<double> x(own.size(), 0.0);
  relaxation.relax(x, map(own, x));
  EXPECT_EQ(relaxation.factor(), 0.5);
  relaxation.relax(x, map(own, x));
  EXPECT_NEAR(relaxation.factor(), 0.25, 1e-14);
  EXPECT_LT(error_of(ranks, map, own, x), 1e-14);
  EXPECT_LT(relaxation.relax(x, map(own, x)), 1e-13);
}

TEST(Aitken, ConvergesWherePlainIterationRunsAway) {
  const Communicator ranks;
  const auto own = own_values(ranks);
  const Map map{3.0, 1.0};  // slopes from -2 to -4
  std::vector<double> plain(own.size(), 0.0), x = plain;
  AitkenRelaxation relaxation(ranks);
  double residual = 1;
  int n = 0;
  while (residual > 1e-12 && n < 100) {
    residual = relaxation.relax(x, map(own, x));
    plain = map(own, plain);
    ++n;
  }
  EXPECT_LT(n, 40);
  EXPECT_LT(error_of(ranks, map, own, x), 1e-11);
  EXPECT_GT(error_of(ranks, map, own, plain), 1e3);
}

TEST(Aitken, FactorsDoNotDependOnHowTheValuesAreShared) {
  const Communicator ranks, alone(MPI_COMM_SELF);
  const auto own = own_values(ranks);
  std::vector<int> all(n_values);
  for (int i = 0; i < n_values; ++i) all[static_cast<std::size_t>(i)] = i;
  const Map map{3.0, 1.0};
  AitkenRelaxation shared(ranks), whole(alone);
  std::vector<double> x(own.size(), 0.0), y(n_values, 0.0);
  for (int n = 0; n < 6; ++n) {
    const double residual = shared.relax(x, map(own, x)), expected = whole.relax(y, map(all, y));
    // Sums in another order; the residual has not yet fallen far.
    EXPECT_NEAR(residual, expected, 1e-12);
    EXPECT_NEAR(shared.factor(), whole.factor(), 1e-9);
  }
}

TEST(Aitken, BeginsTheNextSolveWithWhatItLearnt) {
  const Communicator ranks;
  const auto own = own_values(ranks);
  const Map map{3.0, 0.0};
  AitkenRelaxation relaxation(ranks, 0.5);
  std::vector<double> x(own.size(), 0.0);
  for (int n = 0; n < 2; ++n) relaxation.relax(x, map(own, x));

  AitkenRelaxation restored(ranks, 0.5);
  restored.restore(relaxation.state());
  for (AitkenRelaxation* next : {&relaxation, &restored}) {
    next->restart();
    std::vector<double> z(own.size(), 2.0);
    next->relax(z, map(own, z));
    EXPECT_LT(error_of(ranks, map, own, z), 1e-13);
  }
  EXPECT_THROW(restored.restore(std::vector<double>{1, 2}), RunError);
}

TEST(Aitken, StaysWithinItsBoundsAndBearsASolvedProblem) {
  const Communicator ranks;
  const auto own = own_values(ranks);
  const Map map{-0.99, 0.0};  // the best factor would be 100
  AitkenRelaxation relaxation(ranks, 0.5, 2.0);
  std::vector<double> x(own.size(), 0.0);
  for (int n = 0; n < 3; ++n) relaxation.relax(x, map(own, x));
  EXPECT_EQ(relaxation.factor(), 2.0);
  relaxation.restart();
  EXPECT_EQ(relaxation.factor(), 0.5);
  for (int n = 0; n < 3; ++n) EXPECT_EQ(relaxation.relax(x, std::vector<double>(x)), 0.0);
  EXPECT_TRUE(std::isfinite(relaxation.factor()));
}

TEST(Aitken, HoldsBodiesMuchLighterThanTheFluidTheyCarry) {
  // Bodies of one for every value, with 15 to 25 times their mass of fluid that resists the change of their velocity,
  // fall freely: v = g t m / (m + m_a).
  const Communicator ranks;
  const auto own = own_values(ranks);
  const auto ratio_of = [](int i) { return 20.0 + 5.0 * std::sin(2.0 * i); };
  const double step = 0.1, mass = 0.3, weight = 2.0;
  RigidModel model;
  model.mass = mass;
  model.inertia = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::vector<RigidState> states(own.size());
  AitkenRelaxation relaxation(ranks);
  const int n_steps = 20;
  for (int n = 0; n < n_steps; ++n) {
    std::vector<double> velocities, images(own.size());
    for (const RigidState& state : states) velocities.push_back(state.velocity.z);
    std::vector<RigidState> next = states;
    relaxation.restart();
    double residual = 1;
    int iterations = 0;
    for (; residual > 1e-13 && iterations < 60; ++iterations) {
      for (std::size_t k = 0; k < own.size(); ++k) {
        const double added = ratio_of(own[k]) * mass;
        const RigidLoad load{{0, 0, weight - added * (velocities[k] - states[k].velocity.z) / step}, {}};
        RigidAcceleration acceleration;
        next[k] = advance_rigid_trapezoidal(states[k], acceleration, model, load, load, step);
        images[k] = next[k].velocity.z;
      }
      residual = relaxation.relax(velocities, images);
    }
    ASSERT_LT(iterations, 60);
    states = next;
  }
  // The images carry 25 times the error of the velocities that they come from.
  for (std::size_t k = 0; k < own.size(); ++k)
    EXPECT_NEAR(states[k].velocity.z, weight / mass / (1 + ratio_of(own[k])) * n_steps * step, 1e-10);
}

}  // namespace
}  // namespace pliant
