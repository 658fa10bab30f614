#include "simulation/body_rows.hpp"

#include "diagnostics/shape.hpp"

namespace pliant {
namespace {

/// Collects names or values alike, so that they cannot come apart.
class Row {
 public:
  void add(const char* name, double value) {
    names.push_back(name);
    values.push_back(value);
  }
  void add(const std::string& name, Vec3 v) {
    for (int d = 0; d < 3; ++d) {
      names.push_back(name + "_" + "xyz"[d]);
      values.push_back(v[d]);
    }
  }
  std::vector<std::string> names;
  std::vector<double> values;
};

void add_shape(const Body& body, Row& row) {
  const auto shape = measure_shape(body.surface);
  const auto& fit = shape.ellipsoid;
  row.add("x", fit.centroid.x);
  row.add("y", fit.centroid.y);
  row.add("z", fit.centroid.z);
  row.add("volume", fit.volume);
  row.add("area", shape.area);
  row.add("L", fit.length);
  row.add("B", fit.breadth);
  row.add("W", fit.width);
  row.add("angle", fit.angle);
  row.add("kinetic_energy", shape.kinetic_energy);
  for (const auto& [potential, energy] : shape.energies) row.add(("energy_" + potential).c_str(), energy);
  for (const auto& watch : body.surface.watches) {
    row.add("watch_" + watch.name, watch.mean_of(body.surface.positions));
    row.add("watch_" + watch.name + "_velocity", watch.mean_of(body.surface.velocities));
  }
}

void add_motion(const Body& body, const BodyKind& kind, Row& row) {
  const auto& pose = body.pose;
  row.add("x", pose.center.x);
  row.add("y", pose.center.y);
  row.add("z", pose.center.z);
  if (kind.config.motion == MotionKind::fixed) return;
  row.add("velocity", pose.velocity);
  row.add("q_w", pose.orientation.w);
  row.add("q", Vec3{pose.orientation.x, pose.orientation.y, pose.orientation.z});
  row.add("omega", pose.angular_velocity);
  if (kind.config.motion != MotionKind::hinge) return;
  row.add("angle", body.hinge.angle);
  row.add("rate", body.hinge.rate);
}

void add_loads(const Body& body, const BodyKind& kind, Row& row) {
  row.add("force", body.loads.balance.force);
  row.add("torque", body.loads.balance.torque);
  row.add("probe_force", body.loads.probes.force);
  row.add("probe_torque", body.loads.probes.torque);
  row.add("contact_force", body.loads.contact.force);
  row.add("slip_rms", body.slip.rms());
  row.add("slip_max", body.slip.largest);
  row.add("flux", body.slip.flux);
  if (kind.is_soft() && kind.is_closed()) row.add("volume_restored", body.volume_restored);
}

Row row_of(const Body& body, const BodyKind& kind, bool is_on, long copy, long copies) {
  Row row;
  if (copies > 1) row.add("body", static_cast<double>(copy + 1));
  if (kind.has_pose()) add_motion(body, kind, row);
  else add_shape(body, row);
  if (kind.config.schedule) row.add("on", is_on ? 1 : 0);
  if (kind.acts_on_flow()) add_loads(body, kind, row);
  return row;
}

}  // namespace

std::vector<std::string> body_columns(const BodyKind& kind, long copies) {
  Body specimen;
  specimen.surface = kind.prototype;
  return row_of(specimen, kind, true, 0, copies).names;
}

std::vector<double> body_row(const Body& body, const BodyKind& kind, bool is_on, long copy, long copies) {
  return row_of(body, kind, is_on, copy, copies).values;
}

}  // namespace pliant
