#pragma once
#include <limits>

#include "structure/rigid_body.hpp"

namespace pliant {

/// A rigid body that turns about a fixed axis between two stops.
struct HingeModel {
  Vec3 point;          ///< on the axis
  Vec3 axis{0, 0, 1};  ///< of any length but 0; angles are right-handed about it
  double inertia = 0;  ///< about the axis; see inertia_about
  double min_angle = -std::numeric_limits<double>::infinity();  ///< radians from the reference shape
  double max_angle = std::numeric_limits<double>::infinity();
  double restitution = 0;  ///< rate after an impact on a stop over that before it, 0 to 1
  double damping = 0;      ///< torque = -damping * rate
  double stiffness = 0;    ///< torque = -stiffness * (angle - rest_angle)
  double rest_angle = 0;
  double virtual_inertia = 0;  ///< as in RigidModel
};

/// Plain data, fit for checkpoints and messages.
struct HingeState {
  double angle = 0;  ///< radians from the reference shape
  double rate = 0;
};

/// Acceleration under `torque` about the axis, the spring and the damper, without virtual inertia; 0 if the hinge rests
/// on a stop and is pressed against it.
double hinge_acceleration(const HingeModel& model, const HingeState& state, double torque);

/// Moves a hinge through `step` under a constant torque about its axis (spring and damper come on top).
///
/// Trapezoidal rule for the spring and the damper, exact without them, second order and stable for any step. Within the
/// step the angle follows a parabola, on which impacts are located: there the rate changes to -restitution times
/// itself, and the rest of the step follows. A rebound that would be back at the stop within one step is no longer
/// resolved: the hinge rests on its stop, with the stop's angle to the bit and rate 0, until the torque points away.
/// So does one that hits stops more than 100 times in a step. An angle beyond a stop is first put onto it.
///
/// `acceleration` is as in advance_rigid, without the jumps of impacts: after one, that of the last piece of the step.
void advance_hinge(HingeState& state, double& acceleration, const HingeModel& model, double torque, double step);

/// The same inside an iteration, as advance_rigid_trapezoidal.
HingeState advance_hinge_trapezoidal(const HingeState& start, double& acceleration, const HingeModel& model,
                                     double torque_at_start, double torque_at_end, double step);

/// Position and motion of the body whose centre is at `reference_center` at angle 0.
RigidState pose_of(const HingeModel& model, const HingeState& state, Vec3 reference_center);
RigidAcceleration acceleration_of(const HingeModel& model, const HingeState& state, double acceleration,
                                  Vec3 reference_center);

/// Torque about the hinge's axis of a load about the body's present centre.
double torque_about_axis(const HingeModel& model, const RigidLoad& load, Vec3 center);

}  // namespace pliant
