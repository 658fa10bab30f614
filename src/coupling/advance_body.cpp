#include "coupling/advance_body.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace pliant {

RigidLoad total_load(const Body& body, const BodyKind& kind, const Surroundings& s) {
  const auto& loads = body.loads;
  RigidLoad load = kind.config.loads == LoadSource::probes ? loads.probes : loads.balance;
  const double displaced = s.fluid_density * kind.displaced.volume;
  const Vec3 buoyancy = displaced * (s.driving - s.gravity);
  load.force += kind.mass * s.gravity + buoyancy;
  // Buoyancy acts on the centre of the displaced volume.
  load.torque += cross(rotate(body.pose.orientation, kind.displaced.centroid), buoyancy);
  return load + loads.contact;
}

void move_prescribed(Bodies& bodies, double time) {
  for (Body& body : bodies.own()) {
    const auto& kind = bodies.kind_of(body);
    if (kind.config.motion != MotionKind::prescribed) continue;
    body.pose = prescribed_pose(body, kind, time);
    body.acceleration = prescribed_acceleration(body, kind, time);
    follow_pose(body, kind);
  }
}

void advance_free(Body& body, const BodyKind& kind, const RigidLoad& load, double step) {
  if (kind.config.motion == MotionKind::rigid) {
    advance_rigid(body.pose, body.acceleration, kind.rigid, load, step);
  } else {
    const double torque = torque_about_axis(kind.hinge, load, body.pose.center);
    advance_hinge(body.hinge, body.hinge_acceleration, kind.hinge, torque, step);
    body.pose = hinged_pose(body, kind);
    body.acceleration = acceleration_of(kind.hinge, body.hinge, body.hinge_acceleration, body.start);
  }
  require_finite(body);
  follow_pose(body, kind);
}

void require_finite(const Body& body) {
  if (is_finite(body.pose)) return;
  throw RunError(
      fmt::format("body '{}' is no longer at a finite place; its coupling to the flow is unstable: use coupling = "
                  "\"strong\", or a smaller step",
                  body.name()));
}

}  // namespace pliant
