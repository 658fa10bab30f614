#include "coupling/added_mass.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "config/word.hpp"
#include "flow/flow_solver.hpp"
#include "mesh/geometry.hpp"
#include "structure/placement.hpp"
#include "structure/stable_time_step.hpp"

namespace pliant {
namespace {

// The layer of fluid that markers take along adds to what the body moves in a flow without a grid. Balls of given
// radius over spacing were measured: at 1.5, 3 and 5 loose coupling fails below about 4.3, 1.07 and 0.9 times the
// fluid's density; this gives 3.6, 1.3 and 0.8.
double added_mass(const BodyKind& kind, double area, double spacing) {
  if (!kind.is_closed()) return area * (0.5 * std::sqrt(area) + spacing);
  const double volume = kind.displaced.volume, radius = 3 * volume / area;
  return volume * (0.5 + 7 * spacing * spacing / (radius * radius));
}

double virtual_ratio(const BodyKind& kind) {
  if (kind.config.motion == MotionKind::rigid) return kind.rigid.virtual_mass / kind.rigid.mass;
  return kind.hinge.virtual_inertia / kind.hinge.inertia;
}

CouplingKind choose_for_deformable(const BodyKind& kind, std::string& reason) {
  const auto asked = kind.config.coupling;
  const auto& masses = kind.prototype.masses;
  const bool massless = std::all_of(masses.begin(), masses.end(), [](double m) { return m == 0; });
  if (asked != CouplingKind::automatic) {
    reason = "as given";
    return asked;
  }
  if (massless) {
    reason = "it has no mass of its own";
    return CouplingKind::force_spreading;
  }
  const double steps = kind.convective_step / force_spreading_limit(kind);
  const bool stiff = steps > largest_stiffness;
  reason = fmt::format("its stiffness asks for steps {:.2g} times as short as the flow does, {} {:.2g}", steps,
                       stiff ? "above" : "at most", largest_stiffness);
  return stiff ? CouplingKind::local_mass : CouplingKind::force_spreading;
}

}  // namespace

double wall_mass_ratio(const BodyKind& kind, double fluid_density) {
  const auto& body = kind.prototype;
  const double area = total_area(body.mesh, body.positions);
  const double mass = std::accumulate(body.masses.begin(), body.masses.end(), 0.0);
  const double length = kind.is_closed() ? 3 * kind.displaced.volume / area : std::sqrt(area);
  return mass / (fluid_density * area * length);
}

double force_spreading_limit(const BodyKind& kind) { return substep_safety * kind.layered_limit / largest_alpha; }

double added_mass_ratio(const BodyKind& kind, double fluid_density, double spacing) {
  if (!kind.is_free()) return 0;
  const auto& mesh = kind.prototype.mesh;
  const auto& positions = kind.prototype.positions;
  const double area = total_area(mesh, positions);
  const double added = fluid_density * added_mass(kind, area, spacing);
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
  if (kind.config.motion == MotionKind::deformable) return choose_for_deformable(kind, reason);
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
  const double helped = virtual_ratio(kind);
  const double left = (kind.added_mass_ratio - helped) / (1 + helped);
  const bool light = left > largest_loose_ratio;
  reason = fmt::format("added mass about {:.2g} of its own{}, {} {:.2g}", kind.added_mass_ratio,
                       helped > 0 ? fmt::format(", with what is virtual {:.2g}", left) : "",
                       light ? "above" : "at most", largest_loose_ratio);
  return light ? CouplingKind::strong : CouplingKind::loose;
}

}  // namespace pliant
