#include "coupling/body.hpp"

#include <algorithm>

namespace pliant {
namespace {

PrescribedMotion path_of(const Body& body, const BodyKind& kind) {
  auto path = kind.path;
  if (!kind.config.path.pivot) path.pivot = body.origin;
  return path;
}

}  // namespace

RigidState hinged_pose(const Body& body, const BodyKind& kind) {
  auto pose = pose_of(kind.hinge, body.hinge, body.start);
  pose.orientation = pose.orientation * body.start_orientation;
  return pose;
}

RigidState prescribed_pose(const Body& body, const BodyKind& kind, double time) {
  auto pose = path_of(body, kind).state_at(time, body.start);
  pose.orientation = pose.orientation * body.start_orientation;
  return pose;
}

RigidAcceleration prescribed_acceleration(const Body& body, const BodyKind& kind, double time) {
  return path_of(body, kind).acceleration_at(time, body.start);
}

double extent_of(const BodyKind& kind) {
  double largest = 0;
  for (const Vec3& x : kind.reference) largest = std::max(largest, norm(x));
  return largest;
}

void follow_pose(Body& body, const BodyKind& kind) {
  place_vertices(body.pose, kind.reference, body.surface.positions, body.surface.velocities);
}

}  // namespace pliant
