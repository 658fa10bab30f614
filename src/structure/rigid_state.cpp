#include "structure/rigid_state.hpp"

namespace pliant {

void place_vertices(const RigidState& state, std::span<const Vec3> reference, std::span<Vec3> positions,
                    std::span<Vec3> velocities) {
  const Mat3 rotation = to_matrix(state.orientation);
  for (std::size_t v = 0; v < reference.size(); ++v) {
    const Vec3 r = rotation * reference[v];
    positions[v] = state.center + r;
    velocities[v] = state.velocity + cross(state.angular_velocity, r);
  }
}

bool is_finite(const RigidState& state) {
  const auto finite = [](Vec3 a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); };
  return finite(state.center) && finite(state.velocity) && finite(state.angular_velocity) &&
         std::isfinite(norm(state.orientation));
}

}  // namespace pliant
