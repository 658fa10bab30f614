#include "coupling/body_rates.hpp"

#include <algorithm>
#include <cmath>

namespace pliant {
namespace {

double rate_of(const RigidState& motion, double extent, const Grid& grid) {
  const double turning = norm(motion.angular_velocity) * extent;
  const Vec3 v = motion.velocity;
  return grid.convective_rate({std::abs(v.x) + turning, std::abs(v.y) + turning, std::abs(v.z) + turning});
}

}  // namespace

double convective_rate(const Bodies& bodies) {
  double largest = 0;
  for (const Body& body : bodies.own()) {
    const auto& kind = bodies.kind_of(body);
    if (!kind.has_pose() && kind.forces_flow()) {
      for (const Vec3 v : body.surface.velocities)
        largest = std::max(largest, bodies.grid().convective_rate({std::abs(v.x), std::abs(v.y), std::abs(v.z)}));
      continue;
    }
    if (!kind.has_pose() || !kind.acts_on_flow() || kind.config.motion == MotionKind::fixed) continue;
    largest = std::max(largest, rate_of(body.pose, extent_of(kind), bodies.grid()));
  }
  return largest;
}

double largest_path_rate(const Bodies& bodies, double end) {
  constexpr int samples = 1000;
  double largest = 0;
  for (const auto& kind : bodies.kinds()) {
    if (kind.config.motion != MotionKind::prescribed || !kind.acts_on_flow()) continue;
    for (int n = 0; n <= samples; ++n)
      largest = std::max(
          largest, rate_of(kind.path.state_at(end * n / samples, kind.path.pivot), extent_of(kind), bodies.grid()));
  }
  return largest;
}

}  // namespace pliant
