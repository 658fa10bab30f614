#include "structure/hinge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pliant {
namespace {

HingeModel make_hinge(double inertia) {
  HingeModel hinge;
  hinge.inertia = inertia;
  return hinge;
}

TEST(Hinge, PendulumHasTheExactPeriodAtSecondOrder) {
  // theta'' = -sin(theta) from 1.2 rad: the period is 4 K(sin(0.6)), and back at the start after it.
  const HingeModel hinge = make_hinge(2.0);
  const double period = 4.0 * std::comp_ellint_1(std::sin(0.6));
  const auto error_with = [&](int n_steps) {
    const double step = period / n_steps;
    HingeState state{1.2, 0};
    for (int n = 0; n < n_steps; ++n) {
      HingeState next = state;
      double acceleration = 0;
      for (int i = 0; i < 15; ++i)
        next = advance_hinge_trapezoidal(state, acceleration, hinge, -2.0 * std::sin(state.angle),
                                         -2.0 * std::sin(next.angle), step);
      state = next;
    }
    return std::abs(state.rate);
  };
  EXPECT_LT(error_with(400), 1e-3);
  EXPECT_NEAR(std::log2(error_with(100) / error_with(200)), 2.0, 0.1);
}

TEST(Hinge, SpringKeepsItsEnergyForAnyStep) {
  HingeModel hinge = make_hinge(0.5);
  hinge.stiffness = 50;
  hinge.rest_angle = 0.3;
  for (double step : {0.01, 0.2, 3.0}) {
    HingeState state{0.8, -1};
    const auto energy = [&] { return 0.25 * state.rate * state.rate + 25 * std::pow(state.angle - 0.3, 2); };
    const double start = energy();
    double acceleration = 0;
    for (int n = 0; n < 300; ++n) advance_hinge(state, acceleration, hinge, 0.0, step);
    EXPECT_NEAR(energy() / start, 1.0, 1e-12);  // roundings of 300 steps, larger for step * frequency = 30
  }
}

TEST(Hinge, DamperIsSecondOrderAndNeverOvershoots) {
  HingeModel hinge = make_hinge(1.0);
  hinge.damping = 3.0;
  const auto error_with = [&](int n_steps) {
    HingeState state{0, 1};
    double acceleration = 0;
    for (int n = 0; n < n_steps; ++n) advance_hinge(state, acceleration, hinge, 0.0, 1.0 / n_steps);
    return std::abs(state.rate - std::exp(-3.0));
  };
  EXPECT_NEAR(std::log2(error_with(20) / error_with(40)), 2.0, 0.05);
}

class HingeOnEitherStop : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(LowAndHigh, HingeOnEitherStop, testing::Values(1.0, -1.0));

TEST_P(HingeOnEitherStop, BouncesLoseTheSquareOfTheRestitution) {
  const double side = GetParam();
  HingeModel hinge = make_hinge(2.0);
  (side > 0 ? hinge.min_angle : hinge.max_angle) = 0.25 * side;
  hinge.restitution = 0.8;
  HingeState state{1.25 * side, 0};
  double acceleration = 0, time = 0;
  // Falls with a = 1 from height 1; flights end at sqrt(2) (1 + 2 e + 2 e^2 + ..). Height of the flight by energy.
  double end_of_flight = std::sqrt(2.0);
  int flight = 0;
  const double step = 0.0737;
  while (flight < 5) {
    advance_hinge(state, acceleration, hinge, -2.0 * side, step);
    time += step;
    if (time > end_of_flight) end_of_flight += 2.0 * std::sqrt(2.0) * std::pow(0.8, ++flight);
    const double height = side * state.angle - 0.25 + 0.5 * state.rate * state.rate;
    EXPECT_NEAR(height, std::pow(0.64, flight), 1e-13) << "at time " << time;
    EXPECT_NEAR(acceleration, -side, 1e-14);
  }
}

TEST_P(HingeOnEitherStop, ElasticStopKeepsTheEnergy) {
  const double side = GetParam();
  HingeModel hinge = make_hinge(1.0);
  (side > 0 ? hinge.min_angle : hinge.max_angle) = 0;
  hinge.restitution = 1;
  HingeState state{side, 0};
  double acceleration = 0;
  for (int n = 0; n < 1000; ++n) {
    advance_hinge(state, acceleration, hinge, -side, 0.1);
    ASSERT_NEAR(side * state.angle + 0.5 * state.rate * state.rate, 1.0, 1e-12);
    ASSERT_GE(side * state.angle, 0.0);
  }
}

TEST_P(HingeOnEitherStop, ComesToRestStaysAndLeavesAtOnce) {
  const double side = GetParam(), stop = 0.1 * side;
  for (double restitution : {0.0, 0.5, 0.9}) {
    HingeModel hinge = make_hinge(1.0);
    (side > 0 ? hinge.min_angle : hinge.max_angle) = stop;
    hinge.restitution = restitution;
    HingeState state{1.0 * side, 0};
    double acceleration = 0;
    // Geometric series of flights: at rest after sqrt(1.8) (1 + e) / (1 - e) < 26.
    for (int n = 0; n < 3000; ++n) advance_hinge(state, acceleration, hinge, -side, 0.01);
    EXPECT_EQ(state.angle, stop);
    EXPECT_EQ(state.rate, 0.0);
    // However the pressing torque flutters, it stays to the bit.
    for (int n = 0; n < 200; ++n) {
      const double torque = -side * (1.0 + std::sin(0.7 * n));
      advance_hinge(state, acceleration, hinge, torque, 0.01);
      ASSERT_EQ(state.angle, stop);
      ASSERT_EQ(state.rate, 0.0);
      ASSERT_EQ(acceleration, 0.0);
      ASSERT_EQ(hinge_acceleration(hinge, state, torque), 0.0);
    }
    EXPECT_EQ(hinge_acceleration(hinge, state, 0.5 * side), 0.5 * side);
    advance_hinge(state, acceleration, hinge, 0.5 * side, 0.01);
    EXPECT_NEAR(state.rate, 0.005 * side, 1e-16);
    EXPECT_NEAR(state.angle - stop, 0.25e-4 * side, 1e-16);
  }
}

TEST(Hinge, LocatesTheImpactWithinTheStep) {
  // Rate -2 and no torque: the stop at 0 is met at 0.35; afterwards the rate is 1.
  HingeModel hinge = make_hinge(1.0);
  hinge.min_angle = 0;
  hinge.max_angle = 10;
  hinge.restitution = 0.5;
  HingeState state{0.7, -2};
  double acceleration = 0;
  advance_hinge(state, acceleration, hinge, 0.0, 1.0);
  EXPECT_NEAR(state.angle, 0.65, 1e-15);
  EXPECT_NEAR(state.rate, 1.0, 1e-15);
}

TEST(Hinge, GoesToAndFroBetweenItsStopsInOneStep) {
  HingeModel hinge = make_hinge(1.0);
  hinge.min_angle = 0;
  hinge.max_angle = 1;
  hinge.restitution = 1;
  HingeState state{0.25, 1};
  double acceleration = 0;
  advance_hinge(state, acceleration, hinge, 0.0, 7.3);  // free path 7.55: six whole lengths there and back, 1.55 left
  EXPECT_NEAR(state.angle, 0.45, 1e-13);
  EXPECT_EQ(state.rate, -1.0);
}

TEST(Hinge, WithoutRoomBetweenItsStopsItStays) {
  HingeModel hinge = make_hinge(1.0);
  hinge.min_angle = hinge.max_angle = 0.4;
  hinge.restitution = 0.9;
  HingeState state{0.7, 3};
  double acceleration = 0;
  for (int n = 0; n < 5; ++n) {
    advance_hinge(state, acceleration, hinge, n - 2.0, 0.1);
    EXPECT_EQ(state.angle, 0.4);
  }
  EXPECT_EQ(state.rate, 0.0);
}

TEST(Hinge, VirtualInertiaDampsTheLaggedAddedInertia) {
  for (double virtual_inertia : {0.0, 0.3, 1.0}) {
    HingeModel hinge = make_hinge(0.1);
    hinge.virtual_inertia = virtual_inertia;
    HingeState state;
    double acceleration = 1;
    for (int n = 0; n < 5; ++n) {
      const double old = acceleration;
      advance_hinge(state, acceleration, hinge, -0.5 * old, 1e-3);
      EXPECT_NEAR(acceleration / old, (virtual_inertia - 0.5) / (virtual_inertia + 0.1), 1e-14);
    }
  }
}

TEST(Hinge, NanIsPassedOn) {
  HingeModel hinge = make_hinge(1.0);
  hinge.min_angle = 0;
  HingeState state{1, 0};
  double acceleration = 0;
  advance_hinge(state, acceleration, hinge, std::nan(""), 0.1);
  EXPECT_TRUE(std::isnan(state.angle) && std::isnan(state.rate));
}

TEST(Hinge, PoseMovesAsItsRatesSay) {
  HingeModel hinge = make_hinge(1.0);
  hinge.point = {1, 2, 3};
  hinge.axis = {1, -2, 2};
  const Vec3 reference{2, 2.5, 2};
  const auto state_at = [](double t) { return HingeState{0.4 + 1.1 * t + 0.3 * t * t, 1.1 + 0.6 * t}; };
  const double t = 0.7, h = 1e-4;
  const RigidState pose = pose_of(hinge, state_at(t), reference);
  const RigidState ahead = pose_of(hinge, state_at(t + h), reference);
  const RigidState behind = pose_of(hinge, state_at(t - h), reference);
  const RigidAcceleration acceleration = acceleration_of(hinge, state_at(t), 0.6, reference);
  // Central differences: h^2/6 times third derivatives of about 10.
  EXPECT_LT(norm(pose.velocity - (ahead.center - behind.center) / (2 * h)), 1e-7);
  EXPECT_LT(norm(acceleration.linear - (ahead.velocity - behind.velocity) / (2 * h)), 1e-7);
  EXPECT_LT(norm(acceleration.angular - 0.2 * hinge.axis), 1e-15);
  EXPECT_LT(norm(pose_of(hinge, {}, reference).center - reference), 1e-15);
  // The point on the axis does not move, and power is torque times rate.
  EXPECT_LT(norm(velocity_at(pose, hinge.point)), 1e-15);
  const RigidLoad load{{0.3, 1.4, -0.2}, {0.5, 0, -1}};
  EXPECT_NEAR(torque_about_axis(hinge, load, pose.center) * state_at(t).rate,
              dot(load.force, pose.velocity) + dot(load.torque, pose.angular_velocity), 1e-14);
}

}  // namespace
}  // namespace pliant
