#include "structure/rigid_body.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace pliant {
namespace {

constexpr Mat3 diagonal(double a, double b, double c) { return {{{a, 0, 0}, {0, b, 0}, {0, 0, c}}}; }

RigidModel make_model(Mat3 inertia) {
  RigidModel model;
  model.mass = 2;
  model.inertia = inertia;
  return model;
}

RigidState spinning(Vec3 rate) {
  RigidState state;
  state.orientation = from_axis_angle({1, -1, 0.5}, 0.6);
  state.angular_velocity = rate;
  return state;
}

TEST(RigidBody, FreeRotationKeepsAngularMomentumForAnyStep) {
  const RigidModel model = make_model(diagonal(1, 2, 3.5));
  for (double step : {0.01, 0.3, 2.0}) {
    RigidState state = spinning({0.4, 1.0, -0.7});
    RigidAcceleration acceleration;
    const Vec3 start = angular_momentum(state, model.inertia);
    const int n_steps = 500;
    for (int n = 0; n < n_steps; ++n) advance_rigid(state, acceleration, model, {}, step);
    // Some ten roundings a step that add up at worst.
    EXPECT_LT(norm(angular_momentum(state, model.inertia) - start), n_steps * 10 * 1.1e-16 * norm(start));
    EXPECT_NEAR(norm(state.orientation), 1.0, 1e-15);
  }
}

/// Largest and last deviation of the energy of a tumbling body from its start.
std::pair<double, double> energy_error(double step, double time) {
  const RigidModel model = make_model(diagonal(1, 2, 3.5));
  RigidState state = spinning({0.05, 1.5, 0.1});  // near the unstable axis
  RigidAcceleration acceleration;
  const double start = kinetic_energy(state, model);
  double first_half = 0, largest = 0;
  const int n_steps = static_cast<int>(std::lround(time / step));
  for (int n = 0; n < n_steps; ++n) {
    advance_rigid(state, acceleration, model, {}, step);
    largest = std::max(largest, std::abs(kinetic_energy(state, model) / start - 1));
    if (n == n_steps / 2) first_half = largest;
  }
  return {first_half, largest};
}

TEST(RigidBody, FreeRotationKeepsEnergyAtSecondOrderWithoutDrift) {
  const auto coarse = energy_error(0.1, 200), fine = energy_error(0.05, 200);
  EXPECT_NEAR(std::log2(coarse.second / fine.second), 2.0, 0.1);
  // Symmetric in time: the error oscillates with the tumbling, of which there are tens in each half.
  EXPECT_LT(fine.second, 1.02 * fine.first);
}

TEST(RigidBody, OrientationConvergesAtSecondOrder) {
  const RigidModel model = make_model(diagonal(1, 2, 3.5));
  const auto axis_after = [&](int n_steps) {
    RigidState state = spinning({0.9, 1.5, -0.4});
    RigidAcceleration acceleration;
    // A torque that turns with the world, taken at the middle of the step.
    for (int n = 0; n < n_steps; ++n) {
      const double middle = (n + 0.5) * 4.0 / n_steps;
      advance_rigid(state, acceleration, model, {{}, {std::cos(middle), 0.5, std::sin(2 * middle)}}, 4.0 / n_steps);
    }
    return rotate(state.orientation, {1, 0, 0});
  };
  const Vec3 reference = axis_after(6400);
  const double ratio = norm(axis_after(50) - reference) / norm(axis_after(100) - reference);
  EXPECT_NEAR(std::log2(ratio), 2.0, 0.1);
}

TEST(RigidBody, FreeSymmetricTopPrecessesAboutItsMomentum) {
  const RigidModel model = make_model(diagonal(2, 2, 0.7));
  const auto error_after = [&](int n_steps) {
    RigidState state = spinning({0.8, -0.5, 2.0});
    RigidAcceleration acceleration;
    const Vec3 momentum = angular_momentum(state, model.inertia), start = rotate(state.orientation, {0, 0, 1});
    const double time = 10;
    for (int n = 0; n < n_steps; ++n) advance_rigid(state, acceleration, model, {}, time / n_steps);
    // The axis of symmetry turns about L with the rate |L| / I_1.
    const Vec3 expected = rotate(from_rotation_vector(time / 2.0 * momentum), start);
    return norm(rotate(state.orientation, {0, 0, 1}) - expected);
  };
  EXPECT_LT(error_after(2000), 1e-4);
  EXPECT_NEAR(std::log2(error_after(500) / error_after(1000)), 2.0, 0.05);
}

TEST(RigidBody, HeavyTopPrecessesSteadily) {
  // Steady precession at tilt theta: torque m g l sin(theta) with m g l = I_3 w_3 W - I_1 W^2 cos(theta), w_3 the whole
  // spin along the axis of symmetry.
  const double i1 = 1.0, i3 = 0.6, spin = 9.0, precession = 0.8, tilt = 0.9;
  const double weight_times_arm = i3 * spin * precession - i1 * precession * precession * std::cos(tilt);
  const RigidModel model = make_model(diagonal(i1, i1, i3));
  const auto load_of = [&](const RigidState& state) {
    return RigidLoad{{}, cross(rotate(state.orientation, {0, 0, 1}), Vec3{0, 0, -weight_times_arm})};
  };
  const auto error_after = [&](int n_steps) {
    const double time = 8, step = time / n_steps;
    RigidState state;
    state.orientation = from_axis_angle({0, 1, 0}, tilt);
    const Vec3 axis = rotate(state.orientation, {0, 0, 1});
    // omega = W z + (spin - W cos(tilt)) axis.
    state.angular_velocity = Vec3{0, 0, precession} + (spin - precession * std::cos(tilt)) * axis;
    for (int n = 0; n < n_steps; ++n) {
      const RigidLoad at_start = load_of(state);
      RigidState next = state;
      RigidAcceleration acceleration;
      for (int i = 0; i < 12; ++i)
        next = advance_rigid_trapezoidal(state, acceleration, model, at_start, load_of(next), step);
      state = next;
    }
    const Vec3 expected = rotate(from_axis_angle({0, 0, 1}, precession * time), axis);
    return norm(rotate(state.orientation, {0, 0, 1}) - expected);
  };
  EXPECT_LT(error_after(4000), 1e-4);
  EXPECT_NEAR(std::log2(error_after(1000) / error_after(2000)), 2.0, 0.1);
}

TEST(RigidBody, FallsOnAParabola) {
  RigidModel model = make_model(diagonal(1, 1, 1));
  RigidState state;
  state.velocity = {1, 0, 2};
  RigidAcceleration acceleration;
  for (int n = 0; n < 10; ++n) advance_rigid(state, acceleration, model, {{0, 0.5, -6}, {}}, 0.3);
  EXPECT_LT(norm(state.center - Vec3{3, 0.5 * 0.25 * 9, 6 - 0.5 * 3 * 9}), 1e-13);
  EXPECT_LT(norm(state.velocity - Vec3{1, 0.75, -7}), 1e-13);
  EXPECT_LT(norm(acceleration.linear - Vec3{0, 0.25, -3}), 1e-15);
}

TEST(RigidBody, LockedDirectionsStayToTheBit) {
  RigidModel model = make_model({{{2, 0.3, -0.2}, {0.3, 1.5, 0.4}, {-0.2, 0.4, 1}}});
  model.freedom.translation = {AxisMotion::free, AxisMotion::locked, AxisMotion::locked};
  model.freedom.rotation = {AxisMotion::locked, AxisMotion::locked, AxisMotion::free};
  RigidState state;
  state.center = {0.1, 0.7, 0.3};
  state.velocity.z = 0.25;  // towed
  RigidAcceleration acceleration;
  for (int n = 0; n < 100; ++n) advance_rigid(state, acceleration, model, {{1, 2, 3}, {4, 5, 0.01 * 6}}, 0.1);
  EXPECT_EQ(state.center.y, 0.7);
  EXPECT_EQ(state.velocity.y, 0.0);
  EXPECT_EQ(state.velocity.z, 0.25);
  EXPECT_EQ(state.angular_velocity.x, 0.0);
  EXPECT_EQ(state.angular_velocity.y, 0.0);
  EXPECT_EQ(state.orientation.x, 0.0);
  EXPECT_EQ(state.orientation.y, 0.0);
  // About z alone the inertia is I_zz: omega = T t / I_zz, whatever the products of inertia.
  EXPECT_NEAR(state.angular_velocity.z, 0.6, 1e-13);
  EXPECT_NEAR(state.center.x, 0.1 + 0.5 * 0.5 * 100, 1e-11);

  model.freedom.rotation = {AxisMotion::locked, AxisMotion::locked, AxisMotion::locked};
  model.inertia = {};
  const RigidState before = state;
  advance_rigid(state, acceleration, model, {{}, {1, 1, 1}}, 0.1);
  EXPECT_EQ(state.angular_velocity, before.angular_velocity);
}

TEST(RigidBody, AccelerationIsTheLimitOfAShortStep) {
  RigidModel model = make_model({{{2, 0.3, -0.2}, {0.3, 1.5, 0.4}, {-0.2, 0.4, 1}}});
  for (AxisMotion about_y : {AxisMotion::free, AxisMotion::locked}) {
    model.freedom.rotation[1] = model.freedom.translation[2] = about_y;
    const RigidState start = spinning({1, about_y == AxisMotion::free ? -2.0 : 0.0, 0.5});
    const RigidLoad load{{1, 2, 3}, {0.4, -0.5, 0.6}};
    RigidState state = start;
    RigidAcceleration mean;
    const double step = 1e-6;
    advance_rigid(state, mean, model, load, step);
    const RigidAcceleration now = rigid_acceleration(model, start, load);
    EXPECT_LT(norm(now.linear - mean.linear), 1e-15);
    // Differs by half a step's change, which is of order 10 a unit of time.
    EXPECT_LT(norm(now.angular - mean.angular), 20 * step);
  }
}

TEST(RigidBody, RotationAboutTwoAxesKeepsItsEnergy) {
  RigidModel model = make_model({{{2, 0.3, -0.2}, {0.3, 1.5, 0.4}, {-0.2, 0.4, 1}}});
  model.freedom.rotation[2] = AxisMotion::locked;
  const auto error_with = [&](double step) {
    RigidState state = spinning({0.7, -0.4, 0});
    RigidAcceleration acceleration;
    const double start = kinetic_energy(state, model);
    double largest = 0;
    for (int n = 0; n < std::lround(20 / step); ++n) {
      advance_rigid(state, acceleration, model, {}, step);
      largest = std::max(largest, std::abs(kinetic_energy(state, model) / start - 1));
    }
    EXPECT_EQ(state.angular_velocity.z, 0.0);
    return largest;
  };
  EXPECT_NEAR(std::log2(error_with(0.1) / error_with(0.05)), 2.0, 0.2);
}

TEST(RigidBody, VirtualMassDampsTheLaggedAddedMass) {
  // The fluid resists the last acceleration with its added mass: a' = (m_v - m_a) / (m + m_v) a.
  const double mass = 0.1, added = 0.5;
  const auto history = [&](double virtual_mass) {
    RigidModel model;
    model.mass = mass;
    model.inertia = diagonal(mass, mass, mass);
    model.virtual_mass = model.virtual_inertia = virtual_mass;
    RigidState state;
    RigidAcceleration acceleration{{1, 0, 0}, {0, 1, 0}};
    std::vector<double> factors;
    for (int n = 0; n < 6; ++n) {
      const RigidAcceleration old = acceleration;
      advance_rigid(state, acceleration, model, {-added * old.linear, -added * old.angular}, 1e-3);
      EXPECT_NEAR(acceleration.angular.y, acceleration.linear.x, 1e-9 * std::abs(acceleration.linear.x) + 1e-12);
      factors.push_back(acceleration.linear.x / old.linear.x);
    }
    return factors;
  };
  for (double virtual_mass : {0.0, 0.3, 1.0})
    for (double factor : history(virtual_mass))
      EXPECT_NEAR(factor, (virtual_mass - added) / (mass + virtual_mass), 1e-12);
  EXPECT_GT(std::abs(history(0.0)[0]), 1);  // runs away
  EXPECT_LT(std::abs(history(0.3)[0]), 1);  // dies out
}

TEST(RigidBody, VirtualMassDoesNotChangeSteadyAcceleration) {
  RigidModel model = make_model(diagonal(1, 1, 1));
  model.virtual_mass = 3;
  model.virtual_inertia = 2;
  RigidState state;
  RigidAcceleration acceleration;
  // The lag dies out by m_v / (m + m_v) = 0.6 and I_v / (I + I_v) = 2/3 a step: 100 steps leave 1e-17 of it.
  for (int n = 0; n < 100; ++n) advance_rigid(state, acceleration, model, {{4, 0, 0}, {0, 0, 0.5}}, 0.01);
  EXPECT_NEAR(acceleration.linear.x, 2.0, 1e-14);
  EXPECT_NEAR(acceleration.angular.z, 0.5, 1e-12);
}

TEST(RigidBody, ConvergedIterationDoesNotDependOnVirtualMass) {
  const auto iterate = [](double virtual_mass) {
    RigidModel model = make_model(diagonal(1, 2, 3));
    model.virtual_mass = model.virtual_inertia = virtual_mass;
    RigidState start = spinning({1, 2, 0.5});
    start.velocity = {1, 0, 0};
    const auto load_of = [](const RigidState& s) { return RigidLoad{-1.5 * s.velocity, -0.8 * s.angular_velocity}; };
    RigidState next = start;
    RigidAcceleration acceleration;
    for (int i = 0; i < 100; ++i)
      next = advance_rigid_trapezoidal(start, acceleration, model, load_of(start), load_of(next), 0.1);
    return next;
  };
  const RigidState plain = iterate(0), with_virtual = iterate(1.0);
  EXPECT_LT(norm(plain.velocity - with_virtual.velocity), 1e-13);
  EXPECT_LT(norm(plain.angular_velocity - with_virtual.angular_velocity), 1e-13);
  // Trapezoidal rule for m v' = -c v.
  EXPECT_NEAR(plain.velocity.x, (1 - 0.1 * 1.5 / 4) / (1 + 0.1 * 1.5 / 4), 1e-14);
}

}  // namespace
}  // namespace pliant
