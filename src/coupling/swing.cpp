#include "coupling/swing.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace pliant {
namespace {

constexpr int window = 4, fewest_reversals = 2;
constexpr double growth = 1.05, growth_in_all = 30;

}  // namespace

bool count_swing(SwingCount& swing, Vec3 acceleration, double least) {
  const double size = norm(acceleration);
  if (dot(acceleration, swing.last) < -0.5 * size * norm(swing.last)) ++swing.reversals;
  swing.last = acceleration;
  swing.largest = std::max(swing.largest, size);
  if (++swing.steps < window) return false;
  const double before = swing.largest_before;
  if (swing.reversals < fewest_reversals || swing.largest < growth * before || before == 0) swing.windows = 0;
  else if (swing.windows++ == 0) swing.largest_at_first = before;
  swing.largest_before = swing.largest;
  swing.largest = 0;
  swing.steps = swing.reversals = 0;
  return swing.windows > 1 && swing.largest_before > std::max(least, growth_in_all * swing.largest_at_first);
}

bool is_swinging_up(Body& body, const BodyKind& kind, const RigidLoad& load, double least) {
  const double least_angular = least / extent_of(kind);
  if (kind.config.motion == MotionKind::rigid) {
    const bool along = count_swing(body.swing, body.acceleration.linear, least);
    return count_swing(body.turning_swing, body.acceleration.angular, least_angular) || along;
  }
  const double torque = torque_about_axis(kind.hinge, load, body.told.center);
  return count_swing(body.turning_swing, (torque / kind.hinge.inertia) * kind.hinge.axis, least_angular);
}

std::string explain_swing(const Body& body, const BodyKind& kind) {
  const bool along = body.swing.windows > body.turning_swing.windows;
  const auto& swing = along ? body.swing : body.turning_swing;
  return fmt::format(
      "body '{}': its {} has swung to and fro from step to step over the last {} steps, and grown from {:.3g} to "
      "{:.3g}: "
      "loose coupling is unstable for a body this light (added mass about {:.2g} of its own); use coupling = "
      "\"strong\"",
      body.name(), along ? "acceleration" : "angular acceleration", window * swing.windows, swing.largest_at_first,
      swing.largest_before, kind.added_mass_ratio);
}

}  // namespace pliant
