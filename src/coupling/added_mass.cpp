#include "coupling/added_mass.hpp"

#include <fmt/format.h>

#include <cmath>

#include "config/word.hpp"
#include "mesh/geometry.hpp"
#include "structure/placement.hpp"

namespace pliant {

double added_mass_ratio(const BodyKind& kind, double fluid_density) {
  if (!kind.is_free()) return 0;
  const auto& mesh = kind.prototype.mesh;
  const auto& positions = kind.prototype.positions;
  const double area = total_area(mesh, positions);
  const double added = 0.5 * fluid_density * (kind.is_closed() ? kind.displaced.volume : area * std::sqrt(area));
  if (kind.config.motion == MotionKind::rigid) return added / (kind.rigid.mass);
  // The added mass spread over the surface, about the axis; the surface is where the prototype is, the hinge in the
  // box.
  const auto areas = vertex_areas(mesh, positions);
  const Mat3 back = rotation_about(kind.config.rotation.axis, -kind.config.rotation.angle);
  const Vec3 axis = normalized(back * kind.hinge.axis), point = back * (kind.hinge.point - kind.config.center);
  double squares = 0;
  for (std::size_t v = 0; v < areas.size(); ++v) {
    const Vec3 arm = cross(axis, positions[v] - point);
    squares += areas[v] * dot(arm, arm);
  }
  return added * squares / area / kind.hinge.inertia;
}

CouplingKind choose_coupling(const BodyKind& kind, std::string& reason) {
  const auto asked = kind.config.coupling;
  if (kind.config.motion == MotionKind::deformable) {
    reason = "deformable bodies do not act on the flow";
    return CouplingKind::one_way;
  }
  if (asked == CouplingKind::one_way) {
    reason = "as given";
    return asked;
  }
  if (!kind.is_free()) {
    reason = "its motion does not depend on the flow";
    return CouplingKind::loose;
  }
  if (asked != CouplingKind::automatic) {
    reason = fmt::format("as given; added mass about {:.2g} of its own", kind.added_mass_ratio);
    return asked;
  }
  const bool light = kind.added_mass_ratio > largest_loose_ratio;
  reason = fmt::format("added mass about {:.2g} of its own, {} {:.2g}", kind.added_mass_ratio,
                       light ? "above" : "at most", largest_loose_ratio);
  return light ? CouplingKind::strong : CouplingKind::loose;
}

}  // namespace pliant
