#pragma once
#include <span>

#include "structure/quaternion.hpp"

namespace pliant {

/// Where a rigid body is and how it moves, in the world's frame. Plain data, fit for checkpoints and messages.
struct RigidState {
  Vec3 center;             ///< of mass; not wrapped into the box by periodic sides
  Quaternion orientation;  ///< from the reference shape to the present one; norm 1
  Vec3 velocity;           ///< of the centre
  Vec3 angular_velocity;   ///< radians / time
};

/// Plain data like RigidState.
struct RigidAcceleration {
  Vec3 linear;  ///< of the centre
  Vec3 angular;
};

/// v + omega x (point - centre). `point` must be near the centre's own periodic image.
inline Vec3 velocity_at(const RigidState& state, Vec3 point) {
  return state.velocity + cross(state.angular_velocity, point - state.center);
}

/// Of the body's material at `point`: a + alpha x r + omega x (omega x r), r = point - centre.
inline Vec3 acceleration_at(const RigidState& state, const RigidAcceleration& acceleration, Vec3 point) {
  const Vec3 r = point - state.center;
  return acceleration.linear + cross(acceleration.angular, r) +
         cross(state.angular_velocity, cross(state.angular_velocity, r));
}

/// Puts the vertices where the state says. `reference` holds their places about the centre at orientation 1; all three
/// have one entry a vertex.
void place_vertices(const RigidState& state, std::span<const Vec3> reference, std::span<Vec3> positions,
                    std::span<Vec3> velocities);

/// No component is infinite or NaN.
bool is_finite(const RigidState& state);

}  // namespace pliant
