#include "coupling/hamming.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/error.hpp"
#include "structure/rigid_vector.hpp"

namespace pliant {
namespace {

using Vector = std::vector<double>;

/// y'' = -y as two equations: (cos t, -sin t).
Vector oscillator(std::span<const double> y) { return {y[1], -y[0]}; }

Vector exact(double t) { return {std::cos(t), -std::sin(t)}; }

/// One step with the corrector repeated until it stays.
void step_once(Hamming& scheme, double step, const std::function<Vector(std::span<const double>)>& rate) {
  auto guess = scheme.predict(step);
  Vector y(guess.begin(), guess.end());
  for (int i = 0; i < 60; ++i) {
    const auto next = scheme.correct(rate(y));
    double change = 0;
    for (std::size_t k = 0; k < y.size(); ++k) change = std::max(change, std::abs(next[k] - y[k]));
    y.assign(next.begin(), next.end());
    if (change < 1e-16) break;
  }
  scheme.accept();
}

double error_of(std::span<const double> y, double t) { return std::hypot(y[0] - std::cos(t), y[1] + std::sin(t)); }

double error_with(int n_steps, bool exact_history) {
  const double time = 6, step = time / n_steps;
  std::vector<Hamming::Level> levels;
  for (int k = 0; k < (exact_history ? 4 : 1); ++k) levels.push_back({exact(k * step), oscillator(exact(k * step))});
  const int done = static_cast<int>(levels.size()) - 1;
  Hamming scheme(std::move(levels), step);
  for (int n = done; n < n_steps; ++n) step_once(scheme, step, oscillator);
  return error_of(scheme.value(), time);
}

TEST(Hamming, IsAtLeastFourthOrderWithAFullHistory) {
  // The modifier cancels the leading error, so that the measured order may exceed four.
  const double order = std::log2(error_with(60, true) / error_with(120, true));
  EXPECT_GT(order, 3.9);
  EXPECT_LT(error_with(120, true), 1e-6);
}

TEST(Hamming, StartsByItselfAtThirdOrder) {
  // One trapezoidal step of local error h^3 / 12.
  EXPECT_NEAR(std::log2(error_with(240, false) / error_with(480, false)), 3.0, 0.1);
  const double step = 6.0 / 480;
  EXPECT_NEAR(error_with(480, false), step * step * step / 12, 0.1 * step * step * step / 12);
}

TEST(Hamming, StepsOfChangingLengthAreSecondOrder) {
  const auto error = [](int n_steps) {
    Hamming scheme(exact(0), oscillator(exact(0)));
    double time = 0;
    for (int n = 0; n < n_steps; ++n) {
      const double step = 6.0 / n_steps * (n % 2 == 0 ? 0.9 : 1.1);
      step_once(scheme, step, oscillator);
      time += step;
      EXPECT_EQ(scheme.n_levels(), 2);
    }
    return error_of(scheme.value(), time);
  };
  EXPECT_NEAR(std::log2(error(100) / error(200)), 2.0, 0.05);
}

TEST(Hamming, CollectsItsHistoryAndDropsItWhenTheStepChanges) {
  Hamming scheme(exact(0), oscillator(exact(0)));
  for (int expected : {2, 3, 4, 4}) {
    step_once(scheme, 0.1, oscillator);
    EXPECT_EQ(scheme.n_levels(), expected);
  }
  step_once(scheme, 0.1 * (1 + 1e-14), oscillator);  // the round-off of a difference of times
  EXPECT_EQ(scheme.n_levels(), 4);
  step_once(scheme, 0.05, oscillator);
  EXPECT_EQ(scheme.n_levels(), 2);
}

TEST(Hamming, IntegratesCubicsExactly) {
  // Start-up of exact levels; f is a polynomial of degree 3 in t, carried along as an equation of its own.
  const auto rate = [](std::span<const double> y) { return Vector{4 * y[1] * y[1] * y[1] - 1, 1}; };
  std::vector<Hamming::Level> levels;
  for (int k = 0; k < 4; ++k) {
    const double t = 0.25 * k;
    levels.push_back({{t * t * t * t - t, t}, rate(Vector{0, t})});
  }
  Hamming scheme(std::move(levels), 0.25);
  for (int n = 3; n < 12; ++n) step_once(scheme, 0.25, rate);
  EXPECT_NEAR(scheme.value()[0], 81.0 - 3.0, 1e-12);
}

TEST(Hamming, IsStableOnADampedOscillator) {
  // y'' = -y - 0.4 y' over 100 time units: nothing but the decaying solution is left.
  const auto rate = [](std::span<const double> y) { return Vector{y[1], -y[0] - 0.4 * y[1]}; };
  Hamming scheme(Vector{1, 0}, rate(Vector{1, 0}));
  for (int n = 0; n < 500; ++n) step_once(scheme, 0.2, rate);
  EXPECT_LT(std::hypot(scheme.value()[0], scheme.value()[1]), 2 * std::exp(-0.2 * 100));
}

/// Size of y' after `n_steps` steps of y' = -r (y - y_n) / h, the reaction of an added mass r times the body's.
double reaction_after(double ratio, int n_steps) {
  const double step = 0.1;
  Hamming scheme(Vector{1}, Vector{1});
  for (int n = 0; n < n_steps; ++n) {
    const double last = scheme.value()[0];
    step_once(scheme, step, [&](std::span<const double> y) { return Vector{-ratio * (y[0] - last) / step}; });
  }
  return std::abs(scheme.rate()[0]);
}

TEST(Hamming, BearsAnAddedMassUpToSevenNinths) {
  // The root -1 of the converged scheme's characteristic equation: 103 - 288 r = -121.
  EXPECT_LT(reaction_after(0.97 * 7 / 9, 800), 0.1 * reaction_after(0.97 * 7 / 9, 400));
  EXPECT_GT(reaction_after(1.03 * 7 / 9, 800), 10 * reaction_after(1.03 * 7 / 9, 400));
}

TEST(Hamming, DiscardsAStepThatIsNotAccepted) {
  Hamming once(exact(0), oscillator(exact(0)));
  for (int n = 0; n < 6; ++n) step_once(once, 0.1, oscillator);
  Hamming twice = once;
  twice.predict(0.1);
  twice.correct(Vector{5, 7});
  step_once(once, 0.1, oscillator);
  step_once(twice, 0.1, oscillator);
  EXPECT_EQ(once.state(), twice.state());
}

TEST(Hamming, ContinuesToTheBitFromItsState) {
  for (int n_before : {0, 1, 2, 3, 4, 7}) {
    Hamming scheme(exact(0), oscillator(exact(0)));
    for (int n = 0; n < n_before; ++n) step_once(scheme, 0.1, oscillator);
    Hamming copy = Hamming::from_state(scheme.state());
    EXPECT_EQ(copy.state(), scheme.state());
    for (int n = 0; n < 5; ++n) {
      step_once(scheme, 0.1, oscillator);
      step_once(copy, 0.1, oscillator);
    }
    EXPECT_EQ(copy.state(), scheme.state());
  }
  Vector damaged = Hamming(exact(0), oscillator(exact(0))).state();
  damaged.pop_back();
  EXPECT_THROW(Hamming::from_state(damaged), RunError);
  EXPECT_THROW(Hamming::from_state(Vector{2, std::nan(""), 0, 0}), RunError);
}

TEST(Hamming, TurnsARigidBody) {
  // A free symmetric top: its axis turns about L with the rate |L| / I_1.
  RigidModel model;
  model.mass = 1;
  model.inertia = {{{2, 0, 0}, {0, 2, 0}, {0, 0, 0.7}}};
  RigidState start;
  start.orientation = from_axis_angle({1, -1, 0.5}, 0.6);
  start.velocity = {0, 1, 0};
  start.angular_velocity = {0.8, -0.5, 2.0};
  const Vec3 turn = angular_momentum(start, model.inertia) / 2.0;
  const auto rate = [&](std::span<const double> y) {
    const RigidState state = unpack_rigid(y);
    Vector rates(rigid_vector_size);
    pack_rates(state, rigid_acceleration(model, state, {{0.3, 0, 0}, {}}), rates);
    return rates;
  };
  const auto error_after = [&](int n_steps) {
    const double time = 5;
    Vector y(rigid_vector_size);
    pack(start, y);
    Hamming scheme(y, rate(y));
    for (int n = 0; n < n_steps; ++n) step_once(scheme, time / n_steps, rate);
    const RigidState end = unpack_rigid(scheme.value());
    EXPECT_LT(norm(end.center - Vec3{0.15 * time * time, time, 0}), 1e-13 * time * time * n_steps);
    return norm(rotate(end.orientation, {0, 0, 1}) -
                rotate(from_rotation_vector(time * turn) * start.orientation, {0, 0, 1}));
  };
  // Third order of the start, or better while the fourth order of the other steps is the larger.
  EXPECT_GT(std::log2(error_after(200) / error_after(400)), 2.9);
  EXPECT_LT(error_after(400), 1e-4);
}

TEST(Hamming, HoldsNothingAsWell) {
  Hamming scheme(Vector{}, Vector{});
  step_once(scheme, 0.1, [](std::span<const double>) { return Vector{}; });
  EXPECT_EQ(scheme.size(), 0u);
  EXPECT_EQ(Hamming::from_state(scheme.state()).n_levels(), 2);
}

}  // namespace
}  // namespace pliant
