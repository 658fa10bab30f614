#include "structure/prescribed_motion.hpp"

namespace pliant {
namespace {

/// Value, rate and second derivative of a function of time.
struct Jet {
  double value = 0, first = 0, second = 0;
};

Jet jet_of(const std::function<double(double)>& f, double t, double h) {
  if (!f) return {};
  const double far_behind = f(t - 2 * h), behind = f(t - h), centre = f(t), ahead = f(t + h), far_ahead = f(t + 2 * h);
  return {centre, (8.0 * (ahead - behind) - (far_ahead - far_behind)) / (12.0 * h),
          (16.0 * (ahead + behind) - (far_ahead + far_behind) - 30.0 * centre) / (12.0 * h * h)};
}

struct Pose {
  RigidState state;
  RigidAcceleration acceleration;
};

Pose pose_at(const PrescribedMotion& motion, double time, Vec3 reference_center) {
  Vec3 displacement, velocity, acceleration;
  for (int d = 0; d < 3; ++d) {
    const Jet jet = jet_of(motion.displacement[static_cast<std::size_t>(d)], time, motion.difference_step);
    displacement[d] = jet.value;
    velocity[d] = jet.first;
    acceleration[d] = jet.second;
  }
  const Jet angle = jet_of(motion.angle, time, motion.difference_step);
  const Vec3 axis = normalized(motion.axis);

  Pose pose;
  pose.state.orientation = from_axis_angle(axis, angle.value);
  pose.state.angular_velocity = angle.first * axis;
  pose.acceleration.angular = angle.second * axis;
  const Vec3 arm = rotate(pose.state.orientation, reference_center - motion.pivot);
  const Vec3 swing = cross(pose.state.angular_velocity, arm);
  pose.state.center = motion.pivot + displacement + arm;
  pose.state.velocity = velocity + swing;
  pose.acceleration.linear =
      acceleration + cross(pose.acceleration.angular, arm) + cross(pose.state.angular_velocity, swing);
  return pose;
}

}  // namespace

RigidState PrescribedMotion::state_at(double time, Vec3 reference_center) const {
  return pose_at(*this, time, reference_center).state;
}

RigidAcceleration PrescribedMotion::acceleration_at(double time, Vec3 reference_center) const {
  return pose_at(*this, time, reference_center).acceleration;
}

}  // namespace pliant
