#include "structure/prescribed_motion.hpp"

#include <gtest/gtest.h>

namespace pliant {
namespace {

TEST(PrescribedMotion, EmptyFunctionsAreRest) {
  PrescribedMotion motion;
  motion.pivot = {1, 2, 3};
  const RigidState state = motion.state_at(5.0);
  EXPECT_EQ(state.center, motion.pivot);
  EXPECT_EQ(state.orientation, Quaternion{});
  EXPECT_EQ(state.velocity, Vec3{});
  EXPECT_EQ(state.angular_velocity, Vec3{});
  EXPECT_EQ(motion.acceleration_at(5.0).linear, Vec3{});
}

TEST(PrescribedMotion, RatesOfSmoothFunctionsAreAsExactAsStated) {
  PrescribedMotion motion;
  motion.displacement = {[](double t) { return 0.5 * std::sin(2 * t); }, {}, [](double t) { return 3.0 * t * t; }};
  motion.difference_step = 1e-3;
  const double t = 0.8;
  const RigidState state = motion.state_at(t);
  // h^4 f^(5)/30 with f^(5) = 16 and 2 eps f / h; h^4 f^(6)/90 and 6 eps f / h^2 with f of about 2: 1e-12 and 2e-9.
  EXPECT_LT(norm(state.velocity - Vec3{std::cos(2 * t), 0, 6 * t}), 2e-12);
  EXPECT_LT(norm(motion.acceleration_at(t).linear - Vec3{-2 * std::sin(2 * t), 0, 6}), 4e-9);
  EXPECT_LT(norm(state.center - Vec3{0.5 * std::sin(2 * t), 0, 3 * t * t}), 1e-15);
}

TEST(PrescribedMotion, TurnsAboutThePivotThatItCarriesAlong) {
  PrescribedMotion motion;
  motion.displacement[0] = [](double t) { return t; };
  motion.angle = [](double t) { return 0.5 * t * t; };
  motion.axis = {0, 0, 2};
  motion.pivot = {1, 0, 0};
  const Vec3 reference{3, 0, 0.5};
  const double t = 1.5, angle = 0.5 * t * t, rate = t;
  const Vec3 arm{2 * std::cos(angle), 2 * std::sin(angle), 0.5}, side{-arm.y, arm.x, 0};
  const RigidState state = motion.state_at(t, reference);
  const RigidAcceleration acceleration = motion.acceleration_at(t, reference);
  EXPECT_LT(norm(state.center - (Vec3{1 + t, 0, 0} + arm)), 1e-14);
  EXPECT_LT(norm(state.velocity - (Vec3{1, 0, 0} + rate * side)), 1e-11);
  EXPECT_LT(norm(state.angular_velocity - Vec3{0, 0, rate}), 1e-11);
  EXPECT_LT(norm(acceleration.angular - Vec3{0, 0, 1}), 1e-8);
  EXPECT_LT(norm(acceleration.linear - (side - rate * rate * Vec3{arm.x, arm.y, 0})), 1e-8);
  // The pivot is a point of the body.
  EXPECT_LT(norm(velocity_at(state, {1 + t, 0, 0}) - Vec3{1, 0, 0}), 1e-11);
}

}  // namespace
}  // namespace pliant
