#include "structure/hinge.hpp"

#include <algorithm>
#include <cmath>

namespace pliant {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Least time t >= 0 at which gap + rate t + a t^2 / 2 = 0 is crossed downwards, for gap >= 0. At gap 0 a rate or, at
/// rate 0, an acceleration downwards is a crossing at once.
double time_to_stop(double gap, double rate, double acceleration) {
  if (!std::isfinite(gap)) return never;
  const double discriminant = rate * rate - 2.0 * acceleration * gap;
  if (rate < 0) return discriminant >= 0 ? 2.0 * gap / (std::sqrt(discriminant) - rate) : never;
  return acceleration < 0 ? (rate + std::sqrt(discriminant)) / -acceleration : never;
}

double spring_and_damper(const HingeModel& model, double angle, double rate) {
  return -model.stiffness * (angle - model.rest_angle) - model.damping * rate;
}

/// Trapezoidal rule over `step` without stops, given the torque without spring and damper.
double free_acceleration(const HingeModel& model, const HingeState& state, double torque, double step) {
  const double inertia =
      model.inertia + model.virtual_inertia + 0.5 * step * model.damping + 0.25 * step * step * model.stiffness;
  return (torque + spring_and_damper(model, state.angle + 0.5 * step * state.rate, state.rate)) / inertia;
}

/// The stop at which a move ends first, and when.
struct Impact {
  double time;
  double angle;
  double inwards;  ///< sign of rates that leave the stop
};
Impact next_impact(const HingeModel& model, const HingeState& state, double acceleration) {
  const double low = time_to_stop(state.angle - model.min_angle, state.rate, acceleration);
  const double high = time_to_stop(model.max_angle - state.angle, -state.rate, -acceleration);
  if (low <= high) return {low, model.min_angle, 1.0};
  return {high, model.max_angle, -1.0};
}

}  // namespace

double hinge_acceleration(const HingeModel& model, const HingeState& state, double torque) {
  const double acceleration = (torque + spring_and_damper(model, state.angle, state.rate)) / model.inertia;
  const bool at_low = state.angle <= model.min_angle && state.rate <= 0 && acceleration < 0;
  const bool at_high = state.angle >= model.max_angle && state.rate >= 0 && acceleration > 0;
  return at_low || at_high ? 0.0 : acceleration;
}

void advance_hinge(HingeState& state, double& acceleration, const HingeModel& model, double torque, double step) {
  constexpr int most_impacts = 100;
  const double driving = torque + model.virtual_inertia * acceleration;
  state.angle = std::clamp(state.angle, model.min_angle, model.max_angle);

  double remaining = step;
  for (int impacts = 0; remaining > 0; ++impacts) {
    acceleration = free_acceleration(model, state, driving, remaining);
    const Impact impact = next_impact(model, state, acceleration);
    if (impact.time > remaining) {
      state.angle += remaining * (state.rate + 0.5 * remaining * acceleration);
      state.angle = std::clamp(state.angle, model.min_angle, model.max_angle);
      state.rate += remaining * acceleration;
      return;
    }
    const double rate_at_stop = std::min(0.0, impact.inwards * (state.rate + impact.time * acceleration));
    const double rebound = -model.restitution * rate_at_stop;
    const double press = -impact.inwards * acceleration;
    remaining -= impact.time;
    state = {impact.angle, impact.inwards * rebound};
    const bool is_unresolved = press > 0 && 2.0 * rebound <= press * step;
    if (!is_unresolved && rebound > 0 && impacts < most_impacts) continue;
    state.rate = 0;
    if (is_unresolved || impacts >= most_impacts) {
      acceleration = 0;
      return;
    }
  }
}

HingeState advance_hinge_trapezoidal(const HingeState& start, double& acceleration, const HingeModel& model,
                                     double torque_at_start, double torque_at_end, double step) {
  HingeState state = start;
  advance_hinge(state, acceleration, model, 0.5 * (torque_at_start + torque_at_end), step);
  return state;
}

RigidState pose_of(const HingeModel& model, const HingeState& state, Vec3 reference_center) {
  RigidState pose;
  pose.orientation = from_axis_angle(model.axis, state.angle);
  pose.angular_velocity = state.rate * normalized(model.axis);
  const Vec3 arm = rotate(pose.orientation, reference_center - model.point);
  pose.center = model.point + arm;
  pose.velocity = cross(pose.angular_velocity, arm);
  return pose;
}

RigidAcceleration acceleration_of(const HingeModel& model, const HingeState& state, double acceleration,
                                  Vec3 reference_center) {
  const RigidState pose = pose_of(model, state, reference_center);
  const Vec3 angular = acceleration * normalized(model.axis);
  return {cross(angular, pose.center - model.point) + cross(pose.angular_velocity, pose.velocity), angular};
}

double torque_about_axis(const HingeModel& model, const RigidLoad& load, Vec3 center) {
  return dot(normalized(model.axis), load.torque + cross(center - model.point, load.force));
}

}  // namespace pliant
