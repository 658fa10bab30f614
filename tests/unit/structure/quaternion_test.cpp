#include "structure/quaternion.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <type_traits>
#include <vector>

#include "structure/rigid_vector.hpp"

namespace pliant {
namespace {

static_assert(std::is_trivially_copyable_v<RigidState> && std::is_trivially_copyable_v<RigidAcceleration> &&
              std::is_trivially_copyable_v<HingeState>);

// A few roundings of numbers of order 1.
constexpr double rounding = 4e-15;

TEST(Quaternion, TurnsRightHanded) {
  const Quaternion quarter = from_axis_angle({0, 0, 3}, std::numbers::pi / 2);
  EXPECT_LT(norm(rotate(quarter, {1, 0, 0}) - Vec3{0, 1, 0}), rounding);
  EXPECT_LT(norm(rotate(quarter, {0, 1, 0}) - Vec3{-1, 0, 0}), rounding);
  EXPECT_EQ(rotate(Quaternion{}, {1, 2, 3}), (Vec3{1, 2, 3}));
}

TEST(Quaternion, ProductTurnsByTheSecondFactorFirst) {
  const Quaternion a = from_axis_angle({1, 2, -1}, 0.7), b = from_axis_angle({0, -1, 3}, -2.1);
  const Vec3 v{0.3, -1.2, 0.8};
  EXPECT_LT(norm(rotate(a * b, v) - rotate(a, rotate(b, v))), rounding);
  EXPECT_LT(norm(rotate(conjugate(a), rotate(a, v)) - v), rounding);
  EXPECT_LT(norm(to_matrix(a * b) * v - rotate(a * b, v)), rounding);
  EXPECT_NEAR(norm(rotate(a, v)), norm(v), rounding);
}

TEST(Quaternion, ExponentialIsSmoothThroughZero) {
  const Vec3 axis = normalized(Vec3{1, -2, 2});
  EXPECT_EQ(from_rotation_vector({0, 0, 0}), Quaternion{});
  for (double angle : {1e-12, 1e-5, 0.99e-4, 1.01e-4, 1e-2, 1.0, 3.0, 10.0}) {
    const Quaternion q = from_rotation_vector(angle * axis), expected = from_axis_angle(axis, angle);
    EXPECT_NEAR(norm(q), 1.0, rounding);
    EXPECT_NEAR(q.w, expected.w, rounding);
    EXPECT_LT(norm(Vec3{q.x - expected.x, q.y - expected.y, q.z - expected.z}), rounding * std::min(angle, 1.0));
  }
}

TEST(RigidState, PlacesVerticesThatMoveAsItsVelocitySays) {
  const RigidState state{{3, -2, 1}, from_axis_angle({1, 1, 0}, 0.4), {0.5, 0, -1}, {0.2, -0.7, 1.1}};
  const std::vector<Vec3> reference{{1, 0, 0}, {0, -2, 0.5}, {0, 0, 0}};
  std::vector<Vec3> positions(3), velocities(3);
  place_vertices(state, reference, positions, velocities);
  for (std::size_t v = 0; v < 3; ++v) {
    EXPECT_LT(norm(positions[v] - state.center - rotate(state.orientation, reference[v])), rounding);
    EXPECT_LT(norm(velocities[v] - velocity_at(state, positions[v])), rounding);
  }
  EXPECT_EQ(positions[2], state.center);
}

TEST(RigidState, AccelerationIsTheChangeOfVelocityOfAMaterialPoint) {
  // Rotation about a fixed direction with a growing rate, and a centre on a parabola: all known in closed form.
  const Vec3 axis = normalized(Vec3{1, 2, 3}), drift{0.3, 0.1, -0.2}, push{1, -1, 0.5}, reference{0.4, 0.9, -0.3};
  const auto state_at = [&](double t) {
    return RigidState{t * drift + 0.5 * t * t * push, from_axis_angle(axis, 0.8 * t + 0.35 * t * t), drift + t * push,
                      (0.8 + 0.7 * t) * axis};
  };
  const auto velocity_of_point = [&](double t) {
    const RigidState s = state_at(t);
    return velocity_at(s, s.center + rotate(s.orientation, reference));
  };
  const double t = 1.3, h = 1e-4;
  const RigidState state = state_at(t);
  const Vec3 expected = (velocity_of_point(t + h) - velocity_of_point(t - h)) / (2 * h);
  const Vec3 actual = acceleration_at(state, {push, 0.7 * axis}, state.center + rotate(state.orientation, reference));
  // Central differences: h^2/6 times a third derivative of about 10.
  EXPECT_LT(norm(actual - expected), 1e-7);
}

TEST(RigidState, GoesToNumbersAndBack) {
  const RigidState state{{3, -2, 1}, {0.5, -0.5, 0.5, 0.5}, {0.5, 0, -1}, {0.2, -0.7, 1.1}};
  std::vector<double> numbers(rigid_vector_size), ahead(rigid_vector_size), rates(rigid_vector_size);
  pack(state, numbers);
  const RigidState back = unpack_rigid(numbers);
  EXPECT_EQ(back.center, state.center);
  EXPECT_EQ(back.orientation, state.orientation);
  EXPECT_EQ(back.velocity, state.velocity);
  EXPECT_EQ(back.angular_velocity, state.angular_velocity);
  // Rates are those of a turn about the angular velocity, to first order in a short time.
  const double h = 1e-6;
  pack_rates(state, {}, rates);
  RigidState next = state;
  next.center += h * state.velocity;
  next.orientation = from_rotation_vector(h * state.angular_velocity) * state.orientation;
  pack(next, ahead);
  for (std::size_t k = 0; k < rigid_vector_size; ++k) EXPECT_NEAR((ahead[k] - numbers[k]) / h, rates[k], 1e-6);
}

TEST(RigidState, FiniteMeansEveryComponent) {
  RigidState state;
  EXPECT_TRUE(is_finite(state));
  state.angular_velocity.y = std::nan("");
  EXPECT_FALSE(is_finite(state));
}

}  // namespace
}  // namespace pliant
