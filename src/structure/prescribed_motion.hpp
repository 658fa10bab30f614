#pragma once
#include <array>
#include <functional>

#include "structure/rigid_state.hpp"

namespace pliant {

/// A motion given in time: the body turns by angle(t) about the axis through the pivot, and body and pivot are
/// displaced by displacement(t). An empty function is 0.
///
/// Rates are central differences of fourth order with h = difference_step. For a function f that is smooth on that
/// scale the error of its rate is h^4 f^(5) / 30 + about 2 eps |f| / h, that of its second derivative
/// h^4 f^(6) / 90 + about 6 eps |f| / h^2 (eps = 1.1e-16): 1e-3 of the motion's time scale gives about 1e-12 and 1e-9.
/// Functions are called up to 2 h before and after t. At a kink of a table rates are means over about 2 h.
struct PrescribedMotion {
  std::array<std::function<double(double)>, 3> displacement;
  Vec3 axis{0, 0, 1};                   ///< of any length but 0
  Vec3 pivot;                           ///< at displacement 0
  std::function<double(double)> angle;  ///< radians
  double difference_step = 1e-3;        ///< time

  /// Of a body whose centre is at `reference_center` where displacement and angle are 0.
  RigidState state_at(double time, Vec3 reference_center) const;
  RigidAcceleration acceleration_at(double time, Vec3 reference_center) const;

  /// With the pivot as the body's centre: reference shapes are then taken about the pivot.
  RigidState state_at(double time) const { return state_at(time, pivot); }
  RigidAcceleration acceleration_at(double time) const { return acceleration_at(time, pivot); }
};

}  // namespace pliant
