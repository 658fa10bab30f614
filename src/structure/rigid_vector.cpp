#include "structure/rigid_vector.hpp"

namespace pliant {
namespace {

void put(Vec3 v, std::span<double> at) {
  for (int d = 0; d < 3; ++d) at[static_cast<std::size_t>(d)] = v[d];
}

void put(Quaternion q, std::span<double> at) {
  at[0] = q.w;
  put(Vec3{q.x, q.y, q.z}, at.subspan(1));
}

Vec3 get(std::span<const double> at) { return {at[0], at[1], at[2]}; }

}  // namespace

void pack(const RigidState& state, std::span<double> vector) {
  put(state.center, vector);
  put(state.orientation, vector.subspan(3));
  put(state.velocity, vector.subspan(7));
  put(state.angular_velocity, vector.subspan(10));
}

void pack_rates(const RigidState& state, const RigidAcceleration& acceleration, std::span<double> rates) {
  const Vec3 half = 0.5 * state.angular_velocity;
  put(state.velocity, rates);
  put(Quaternion{0, half.x, half.y, half.z} * state.orientation, rates.subspan(3));
  put(acceleration.linear, rates.subspan(7));
  put(acceleration.angular, rates.subspan(10));
}

RigidState unpack_rigid(std::span<const double> vector) {
  const Quaternion orientation{vector[3], vector[4], vector[5], vector[6]};
  return {get(vector), normalized(orientation), get(vector.subspan(7)), get(vector.subspan(10))};
}

void pack(const HingeState& state, std::span<double> vector) {
  vector[0] = state.angle;
  vector[1] = state.rate;
}

void pack_rates(const HingeState& state, double acceleration, std::span<double> rates) {
  rates[0] = state.rate;
  rates[1] = acceleration;
}

HingeState unpack_hinge(std::span<const double> vector) { return {vector[0], vector[1]}; }

}  // namespace pliant
