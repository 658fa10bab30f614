#include "structure/rigid_body.hpp"

namespace pliant {
namespace {

/// R I R^T v.
Vec3 turned(Quaternion orientation, const Mat3& inertia, Vec3 v) {
  return rotate(orientation, inertia * rotate(conjugate(orientation), v));
}

/// Solves (R I R^T + I_v) omega = momentum in the free directions; omega keeps its values in the locked ones.
Vec3 solve_rate(const RigidModel& model, Quaternion orientation, Vec3 momentum, Vec3 omega) {
  const auto is_free = [&](int d) { return model.freedom.rotation[d] == AxisMotion::free; };
  Vec3 held, columns[3];
  for (int d = 0; d < 3; ++d)
    if (!is_free(d)) held[d] = omega[d];
  Vec3 right = momentum - turned(orientation, model.inertia, held);
  for (int d = 0; d < 3; ++d) {
    Vec3 unit;
    unit[d] = 1;
    if (is_free(d)) {
      columns[d] = turned(orientation, model.inertia, unit) + model.virtual_inertia * unit;
      for (int row = 0; row < 3; ++row)
        if (!is_free(row)) columns[d][row] = 0;
    } else {
      columns[d] = unit;
      right[d] = 0;
    }
  }

  const Vec3 yz = cross(columns[1], columns[2]), zx = cross(columns[2], columns[0]), xy = cross(columns[0], columns[1]);
  const double determinant = dot(columns[0], yz);
  const Vec3 solution{dot(right, yz) / determinant, dot(right, zx) / determinant, dot(right, xy) / determinant};
  for (int d = 0; d < 3; ++d)
    if (is_free(d)) omega[d] = solution[d];
  return omega;
}

void advance_rotation(RigidState& state, Vec3& acceleration, const RigidModel& model, Vec3 torque, double step) {
  // Far more than a sensible step needs; momentum is right at any count.
  constexpr int most_iterations = 30;
  constexpr double tolerance = 1e-15;
  const Vec3 rate = state.angular_velocity;
  const Vec3 momentum = turned(state.orientation, model.inertia, rate) + model.virtual_inertia * rate;
  const Vec3 change = step * (torque + model.virtual_inertia * acceleration);

  Vec3 next = rate;
  Quaternion turned_to;
  for (int i = 0; i < most_iterations; ++i) {
    turned_to = normalized(from_rotation_vector(0.5 * step * (rate + next)) * state.orientation);
    const Vec3 last = next;
    next = solve_rate(model, turned_to, momentum + change, rate);
    if (norm(next - last) <= tolerance * norm(next)) break;
  }
  state.orientation = turned_to;
  state.angular_velocity = next;
  acceleration = (next - rate) / step;
}

}  // namespace

void advance_rigid(RigidState& state, RigidAcceleration& acceleration, const RigidModel& model, const RigidLoad& load,
                   double step) {
  for (int d = 0; d < 3; ++d) {
    const double old_velocity = state.velocity[d];
    double& a = acceleration.linear[d];
    a = model.freedom.translation[d] == AxisMotion::free
            ? (load.force[d] + model.virtual_mass * a) / (model.mass + model.virtual_mass)
            : 0.0;
    if (a != 0) state.velocity[d] = old_velocity + step * a;
    state.center[d] += 0.5 * step * (old_velocity + state.velocity[d]);
  }
  advance_rotation(state, acceleration.angular, model, load.torque, step);
}

RigidState advance_rigid_trapezoidal(const RigidState& start, RigidAcceleration& acceleration, const RigidModel& model,
                                     const RigidLoad& load_at_start, const RigidLoad& load_at_end, double step) {
  RigidState state = start;
  const RigidLoad mean{0.5 * (load_at_start.force + load_at_end.force),
                       0.5 * (load_at_start.torque + load_at_end.torque)};
  advance_rigid(state, acceleration, model, mean, step);
  return state;
}

RigidAcceleration rigid_acceleration(const RigidModel& model, const RigidState& state, const RigidLoad& load) {
  RigidModel plain = model;
  plain.virtual_inertia = 0;
  RigidAcceleration acceleration;
  for (int d = 0; d < 3; ++d)
    if (model.freedom.translation[d] == AxisMotion::free) acceleration.linear[d] = load.force[d] / model.mass;
  const Vec3 gyroscopic = cross(state.angular_velocity, angular_momentum(state, model.inertia));
  acceleration.angular = solve_rate(plain, state.orientation, load.torque - gyroscopic, {});
  return acceleration;
}

Vec3 angular_momentum(const RigidState& state, const Mat3& inertia) {
  return turned(state.orientation, inertia, state.angular_velocity);
}

double kinetic_energy(const RigidState& state, const RigidModel& model) {
  return 0.5 * model.mass * dot(state.velocity, state.velocity) +
         0.5 * dot(state.angular_velocity, angular_momentum(state, model.inertia));
}

}  // namespace pliant
