#pragma once
#include <span>

#include "core/vec3.hpp"

namespace pliant {

/// A force and its torque about a point that goes with it.
struct RigidLoad {
  Vec3 force, torque;

  friend constexpr RigidLoad operator+(RigidLoad a, RigidLoad b) { return {a.force + b.force, a.torque + b.torque}; }
};

/// Sum of forces at positions, torque about `center`. Positions must not be wrapped around periodic sides.
inline RigidLoad total_load(std::span<const Vec3> positions, std::span<const Vec3> forces, Vec3 center) {
  RigidLoad sum;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    sum.force += forces[i];
    sum.torque += cross(positions[i] - center, forces[i]);
  }
  return sum;
}

}  // namespace pliant
