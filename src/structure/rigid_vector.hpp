#pragma once
#include <cstddef>
#include <span>

#include "structure/hinge.hpp"

/// Bodies as the plain numbers that time integrators work on. A message or a checkpoint may copy the structs
/// themselves.
namespace pliant {

/// Centre, quaternion (w, x, y, z), velocity, angular velocity.
inline constexpr std::size_t rigid_vector_size = 13;
/// Angle and rate.
inline constexpr std::size_t hinge_vector_size = 2;

void pack(const RigidState& state, std::span<double> vector);
/// The rates of the numbers of pack: q' = (0, omega) q / 2.
void pack_rates(const RigidState& state, const RigidAcceleration& acceleration, std::span<double> rates);
/// The way back; the quaternion is brought to norm 1.
RigidState unpack_rigid(std::span<const double> vector);

void pack(const HingeState& state, std::span<double> vector);
void pack_rates(const HingeState& state, double acceleration, std::span<double> rates);
HingeState unpack_hinge(std::span<const double> vector);

}  // namespace pliant
