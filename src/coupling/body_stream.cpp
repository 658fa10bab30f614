#include "coupling/body_stream.hpp"

namespace pliant {
namespace {

void read_vertices(ByteReader& in, std::vector<Vec3>& values) {
  const std::size_t expected = values.size();
  in.read(values);
  if (values.size() != expected) throw ByteStreamError("a body has another number of vertices than its surface");
}

}  // namespace

void write_body(const Body& body, const BodyKind& kind, ByteWriter& out) {
  out.write(body.origin);
  out.write(body.start);
  out.write(body.start_orientation);
  out.write(body.pose);
  out.write(body.acceleration);
  out.write(body.hinge);
  out.write(body.hinge_acceleration);
  out.write(body.told);
  out.write(body.told_before);
  out.write(body.met);
  out.write(body.loads);
  out.write(body.scheme);
  out.write(body.swing);
  out.write(body.turning_swing);
  out.write(body.carried_forces);
  if (kind.has_pose()) return;  // the vertices follow
  out.write(body.surface.positions);
  out.write(body.surface.velocities);
  out.write(body.surface.forces);
  for (const auto* values :
       {&body.told_positions, &body.told_velocities, &body.flow_forces, &body.accelerations, &body.mass_velocities})
    out.write(*values);
  out.write(body.volume_restored);
}

void read_body(ByteReader& in, const BodyKind& kind, Body& body) {
  in.read(body.origin);
  in.read(body.start);
  in.read(body.start_orientation);
  body.surface.origin = body.origin;
  body.surface.orientation = body.start_orientation;
  in.read(body.pose);
  in.read(body.acceleration);
  in.read(body.hinge);
  in.read(body.hinge_acceleration);
  in.read(body.told);
  in.read(body.told_before);
  in.read(body.met);
  in.read(body.loads);
  in.read(body.scheme);
  in.read(body.swing);
  in.read(body.turning_swing);
  in.read(body.carried_forces);
  if (kind.has_pose()) {
    follow_pose(body, kind);
    return;
  }
  read_vertices(in, body.surface.positions);
  read_vertices(in, body.surface.velocities);
  read_vertices(in, body.surface.forces);
  for (auto* values :
       {&body.told_positions, &body.told_velocities, &body.flow_forces, &body.accelerations, &body.mass_velocities})
    in.read(*values);
  in.read(body.volume_restored);
}

}  // namespace pliant
