#include "coupling/make_body_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/validate.hpp"
#include "core/angles.hpp"
#include "core/error.hpp"
#include "coupling/added_mass.hpp"
#include "mesh/geometry.hpp"
#include "signals/make_signal.hpp"
#include "structure/make_body.hpp"
#include "structure/placement.hpp"
#include "structure/select_vertices.hpp"
#include "structure/stable_time_step.hpp"
#include "transfer/direct_forcing.hpp"

namespace pliant {
namespace {

std::string place_of(const CaseConfig& config, const BodyKind& kind) {
  return place_of(config, "body." + kind.config.name);
}

Mat3 diagonal(Vec3 d) { return {{{d.x, 0, 0}, {0, d.y, 0}, {0, 0, d.z}}}; }

Mat3 scaled(const Mat3& m, double factor) { return {{factor * m[0], factor * m[1], factor * m[2]}}; }

/// Mass, centre of mass and inertia of what the body is made of.
MassProperties material_of(const BodyKind& kind, const CaseConfig& config) {
  const auto& material = kind.config.material;
  const auto& body = kind.prototype;
  const double density = material.density.value_or(config.fluid.density);
  if (!body.mesh.is_closed() && material.thickness == 0)
    throw InputError(place_of(config, kind) +
                     " is an open surface, which has no volume: give the thickness of its wall, or surface.file a "
                     "closed mesh");
  auto properties = material.thickness > 0
                        ? shell_mass_properties(body.mesh, body.positions, density, material.thickness)
                        : solid_mass_properties(body.mesh, body.positions, density);
  if (material.mass) {
    properties.inertia = scaled(properties.inertia, *material.mass / properties.mass);
    properties.mass = *material.mass;
  }
  if (material.inertia) properties.inertia = diagonal(*material.inertia);
  return properties;
}

Freedom freedom_of(const RigidConfig& rigid) {
  Freedom freedom;
  for (int d = 0; d < 3; ++d) {
    const auto at = static_cast<std::size_t>(d);
    freedom.translation[at] = rigid.free_translation[d] != 0 ? AxisMotion::free : AxisMotion::locked;
    freedom.rotation[at] = rigid.free_rotation[d] != 0 ? AxisMotion::free : AxisMotion::locked;
  }
  return freedom;
}

void set_rigid(BodyKind& kind, const MassProperties& material, const CaseConfig& config) {
  const auto& rigid = kind.config.rigid;
  const double share = rigid.virtual_mass * config.fluid.density;
  const auto& second = kind.displaced.second;
  kind.rigid.mass = material.mass;
  kind.rigid.inertia = material.inertia;
  kind.rigid.virtual_mass = share * kind.displaced.volume;
  // Isotropic: the mean moment of the displaced fluid.
  kind.rigid.virtual_inertia = share * 2.0 / 3.0 * (second[0].x + second[1].y + second[2].z);
  kind.rigid.freedom = freedom_of(rigid);
}

void set_hinge(BodyKind& kind, const MassProperties& material) {
  const auto& hinge = kind.config.hinge;
  auto& model = kind.hinge;
  model.point = hinge.point;
  model.axis = normalized(hinge.axis);
  // The material is where the prototype is, the hinge is in the box.
  const Mat3 back = rotation_about(kind.config.rotation.axis, -kind.config.rotation.angle);
  model.inertia =
      hinge.inertia.value_or(inertia_about(material, back * (hinge.point - kind.config.center), back * hinge.axis));
  if (hinge.min_angle) model.min_angle = degree * *hinge.min_angle;
  if (hinge.max_angle) model.max_angle = degree * *hinge.max_angle;
  model.restitution = hinge.restitution;
  model.damping = hinge.damping;
  model.stiffness = hinge.stiffness;
  model.rest_angle = degree * hinge.rest_angle;
  model.virtual_inertia = hinge.virtual_inertia;
}

void set_path(BodyKind& kind, const CaseConfig& config) {
  const auto& path = kind.config.path;
  const auto signals = make_signals(config);
  const auto function = [&](const std::string& text) -> std::function<double(double)> {
    if (text.empty()) return nullptr;
    return [signal = make_signal_or_formula(text, signals)](double t) { return signal.value(t); };
  };
  kind.path.displacement = {function(path.x), function(path.y), function(path.z)};
  if (auto degrees = function(path.angle)) kind.path.angle = [degrees](double t) { return degree * degrees(t); };
  kind.path.axis = path.axis;
  kind.path.pivot = path.pivot.value_or(Vec3{});
  kind.path.difference_step = 1e-5 * config.time.end;
}

ProbeForm probe_form(TractionForm form) {
  if (form == TractionForm::gradient) return ProbeForm::gradient;
  return form == TractionForm::quadratic ? ProbeForm::quadratic : ProbeForm::one_sided;
}

void set_shape(BodyKind& kind, const Grid& grid) {
  const auto& body = kind.prototype;
  const bool closed = body.mesh.is_closed();
  if (closed) kind.displaced = enclosed_moments(body.mesh, body.positions);
  kind.reference = body.positions;
  for (Vec3& x : kind.reference) x -= kind.centroid;
  if (closed) kind.displaced.centroid -= kind.centroid;
  const bool retracts = kind.config.motion != MotionKind::deformable;
  const double retraction =
      grid.mean_spacing() * kind.config.marker_retraction.value_or(retracts ? marker_retraction : 0.0);
  kind.layout = kind.config.marker_refinement > 0
                    ? MarkerLayout(body.mesh, kind.config.marker_refinement)
                    : MarkerLayout(body.mesh, refinement_for(body.mesh, body.positions, grid.smallest_spacing()));
  if (closed) kind.retraction = retraction;
  else if (retraction > 0) kind.layout.draw_in(body.mesh, body.positions, retraction);
}

/// The faces of the selections that the case names, and the rest. Keys that do not apply may be there, if others were
/// overridden.
void set_tight_parts(BodyKind& kind, const std::vector<NamedVertices>& of_surface, const CaseConfig& config) {
  if (!kind.config.tight || kind.config.motion != MotionKind::fixed || kind.config.coupling == CouplingKind::one_way)
    return;
  const auto& body = kind.prototype;
  const auto all = body.mesh.vertices_of_face();
  std::vector<Face> rest(all.begin(), all.end());
  for (const auto& name : kind.config.tight_parts) {
    std::vector<bool> is_selected(body.positions.size(), false);
    for (int v : select_vertices(kind.config, name, body.mesh, body.positions, of_surface))
      is_selected[static_cast<std::size_t>(v)] = true;
    const auto part = std::stable_partition(rest.begin(), rest.end(), [&](const Face& face) {
      return !std::all_of(face.begin(), face.end(), [&](int v) { return is_selected[static_cast<std::size_t>(v)]; });
    });
    if (part == rest.end())
      throw InputError(fmt::format("{} names \"{}\", which holds no whole face that is not in a selection before it",
                                   place_of(config, "body." + kind.config.name + ".tight_parts"), name));
    kind.tight_parts.emplace_back(part, rest.end());
    rest.erase(part, rest.end());
  }
  if (!rest.empty()) kind.tight_parts.push_back(std::move(rest));
}

/// The step of the flow at the largest speed that the case names.
double convective_step(const CaseConfig& config, const Grid& grid) {
  double rate = grid.convective_rate(config.initial.velocity);
  if (config.initial.flow == InitialFlow::taylor_green || config.initial.flow == InitialFlow::poiseuille)
    rate = std::max(rate, std::abs(config.initial.amplitude) / grid.smallest_spacing());
  for (const auto& side : config.boundary) {
    if (const auto* wall = std::get_if<WallSide>(&side)) rate = std::max(rate, grid.convective_rate(wall->velocity));
    if (const auto* inflow = std::get_if<InflowSide>(&side))
      rate = std::max(rate, grid.convective_rate(inflow->velocity));
  }
  if (const auto& bulk = config.forcing.bulk_velocity)
    rate = std::max(rate, std::abs(bulk->value) / grid.smallest_spacing());
  return config.time.step.value_or(config.time.cfl / rate);
}

void set_step_limits(BodyKind& kind, const CaseConfig& config, const Grid& grid) {
  if (kind.has_pose() || kind.config.coupling == CouplingKind::one_way) return;
  const auto& body = kind.prototype;
  auto masses = body.masses;
  for (std::size_t v = 0; v < masses.size(); ++v)
    masses[v] += config.fluid.density * grid.mean_spacing() * body.reference_areas[v];
  kind.layered_limit =
      stable_time_step(find_largest_frequency(body, masses), 0, find_largest_damping_rate(body, masses));
  kind.convective_step = convective_step(config, grid);
  kind.wall_mass_ratio = wall_mass_ratio(kind, config.fluid.density);
  if (kind.config.coupling == CouplingKind::loose && kind.wall_mass_ratio < least_loose_wall)
    throw InputError(fmt::format(
        "{} has a wall of {:.2g} times the mass of the fluid around it, and coupling = \"loose\" holds from {} on, "
        "whatever the step; write \"force-spreading\", \"local-mass\" or \"strong\", or leave the choice to \"auto\"",
        place_of(config, kind), kind.wall_mass_ratio, least_loose_wall));
}

/// A soft body meets the flow at its vertices, if faces are small enough for the grid; marker points serve all others.
void set_softness(BodyKind& kind, const Grid& grid) {
  if (!kind.is_soft()) return;
  const auto& body = kind.prototype;
  const auto lengths = edge_lengths(body.mesh, body.positions);
  kind.meets_flow_at_vertices =
      kind.config.marker_refinement == 0 &&
      *std::max_element(lengths.begin(), lengths.end()) <= longest_marker_edge * grid.smallest_spacing();
  // Centroids alone would not feel vertices that alternate by threes.
  if (!kind.meets_flow_at_vertices && kind.config.marker_refinement == 0) {
    auto parts = refinement_for(body.mesh, body.positions, grid.smallest_spacing());
    for (int& n : parts) n = std::max(n, 2);
    kind.layout = MarkerLayout(body.mesh, parts);
  }
  kind.restores_volume = kind.is_closed() && kind.config.volume_correction;
}

/// A marker that stands for more than about two cells overshoots, and the flow blows up.
void require_enough_markers(const BodyKind& kind, const CaseConfig& config, const Grid& grid) {
  MarkerSet markers;
  kind.layout.place(kind.prototype.positions, kind.prototype.velocities, markers);
  const double largest = *std::max_element(markers.areas.begin(), markers.areas.end());
  const double correction = largest * grid.mean_spacing() / (grid.dx() * grid.dy() * grid.smallest_dz());
  if (!kind.acts_on_flow() || kind.meets_flow_at_vertices || correction < DirectForcing::largest_stable_correction)
    return;
  throw InputError(
      fmt::format("{} has too few markers for the grid: one stands for {:.2g} cells, from {} on forcing is unstable; "
                  "leave marker_refinement to Pliant, or raise it",
                  place_of(config, kind), correction, DirectForcing::largest_stable_correction));
}

/// Contact of a body whose own sides are within range of each other everywhere says nothing.
void require_short_range(const BodyKind& kind, const CaseConfig& config) {
  if (kind.has_pose() || !(config.repulsion.strength > 0)) return;
  const double least = kind.is_closed() ? kind.prototype.radius
                                        : 0.5 * std::sqrt(total_area(kind.prototype.mesh, kind.prototype.positions));
  if (config.repulsion.range <= 0.5 * least) return;
  throw InputError(
      fmt::format("{} is {}, more than half of the size of body '{}' ({:.4g}); for contact of deformable bodies one to "
                  "one and a half "
                  "grid spacings ({:.4g}) will do",
                  place_of(config, "repulsion.range"), config.repulsion.range, kind.config.name, least,
                  config.box.size.x / config.box.cells[0]));
}

}  // namespace

BodyKind make_body_kind(const CaseConfig& config, std::size_t index, Surface shape, const Grid& grid) {
  BodyKind kind;
  kind.config = config.bodies[index];
  const auto selections = shape.selections;
  kind.prototype = make_body(kind.config, std::move(shape), grid.mean_spacing(), config.fluid.density);
  auto& body = kind.prototype;
  const bool closed = body.mesh.is_closed();
  MassProperties material;
  if (kind.is_free()) {
    material = material_of(kind, config);
    kind.centroid = material.centroid;
    kind.mass = material.mass;
  } else if (closed) {
    kind.centroid = enclosed_moments(body.mesh, body.positions).centroid;
  } else {
    kind.centroid = shell_mass_properties(body.mesh, body.positions, 1.0, 1.0).centroid;
  }
  set_shape(kind, grid);
  set_tight_parts(kind, selections, config);
  if (kind.config.motion == MotionKind::rigid) set_rigid(kind, material, config);
  if (kind.config.motion == MotionKind::hinge) set_hinge(kind, material);
  if (kind.config.motion == MotionKind::prescribed) set_path(kind, config);
  kind.probes.form = probe_form(body.traction.form);
  kind.probes.wetting = closed && kind.has_pose() ? Wetting::outside : Wetting::both_sides;
  if (kind.retraction == 0 && !kind.is_thin_sheet()) kind.probes.offset = forced_surface_offset * grid.mean_spacing();
  kind.probes.length = body.traction.probe_length;
  kind.probes.density = config.fluid.density;
  kind.probes.viscosity = config.fluid.viscosity;
  kind.added_mass_ratio = added_mass_ratio(kind, config.fluid.density, grid.mean_spacing());
  kind.spacing = grid.mean_spacing();
  set_step_limits(kind, config, grid);
  std::string reason;
  kind.coupling = choose_coupling(kind, reason);
  set_softness(kind, grid);
  require_enough_markers(kind, config, grid);
  require_short_range(kind, config);
  return kind;
}

}  // namespace pliant
