#include "loads/momentum_balance.hpp"

namespace pliant {
namespace {

/// integral of (x - center)(x - center)^T applied to a vector: second moment about the centroid and Steiner's part.
Vec3 second_about(const SolidMoments& moments, Vec3 arm, Vec3 a) {
  return moments.second * a + (moments.volume * dot(arm, a)) * arm;
}

double trace_about(const SolidMoments& moments, Vec3 arm) {
  return moments.second[0].x + moments.second[1].y + moments.second[2].z + moments.volume * dot(arm, arm);
}

}  // namespace

RigidLoad momentum_balance(const RigidLoad& of_markers, const InnerFluid& fluid, const InnerMotion& body,
                           Vec3 center) {
  const auto& moments = fluid.moments;
  const Vec3 arm = moments.centroid - center, omega = body.angular_velocity;
  const Vec3 of_centroid = body.linear + cross(body.angular, arm) + cross(omega, cross(omega, arm));
  const double trace = trace_about(moments, arm);
  const auto inertia_times = [&](Vec3 a) { return trace * a - second_about(moments, arm, a); };

  RigidLoad load = of_markers;
  load.force += (fluid.density * moments.volume) * (of_centroid - fluid.acceleration);
  load.torque += fluid.density * (moments.volume * cross(arm, body.linear - fluid.acceleration) +
                                  inertia_times(body.angular) + cross(omega, inertia_times(omega)));
  return load;
}

}  // namespace pliant
