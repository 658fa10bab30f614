#include "structure/make_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "core/error.hpp"
#include "mesh/geometry.hpp"
#include "potentials/moduli.hpp"
#include "structure/select_vertices.hpp"
#include "structure/stable_time_step.hpp"

namespace pliant {

namespace {

std::vector<double> wall_stiffness(const MaterialConfig& material, const TriangleMesh& mesh,
                                   std::span<const Vec3> reference) {
  if (!material.fibre) return van_gelder_stiffness(mesh, reference, *material.young, material.thickness);
  const auto fibre = fibre_stiffness(*material.fibre, *material.young, material.young_across.value_or(*material.young));
  return fibre_network_stiffness(mesh, reference, fibre, material.thickness);
}

SheetLaw law_of(const MembraneConfig& given) {
  if (given.law == MembraneLaw::skalak) return Skalak{given.shear, given.ratio};
  return NeoHookean{given.shear};
}

void add_in_plane(const BodyConfig& config, const TriangleMesh& mesh, std::span<const Vec3> reference,
                  PotentialSet& set) {
  const auto& given = config.potentials;
  if (given.edge) set.add(EdgeSprings::uniform(mesh, reference, given.edge->stiffness, given.edge->rest_length));
  if (given.membrane) set.add(Membrane::about_shape(mesh, reference, law_of(*given.membrane)));
  if (given.edge || given.membrane || !config.material.young) return;
  set.add(EdgeSprings{wall_stiffness(config.material, mesh, reference), edge_lengths(mesh, reference)});
}

void add_bending(const BodyConfig& config, const TriangleMesh& mesh, std::span<const Vec3> reference,
                 PotentialSet& set) {
  const auto& given = config.potentials.bending;
  const auto& material = config.material;
  if (!given && !material.young) return;
  const bool about_shape = !given || given->reference == ReferenceAngle::initial;
  auto bending = about_shape ? Bending::about_shape(mesh, reference, 0) : Bending::about_flat(mesh, 0);
  if (given) bending.stiffness.assign(bending.stiffness.size(), given->stiffness);
  else
    bending.stiffness =
        hinge_stiffness(mesh, reference, bending_modulus(*material.young, material.thickness, material.poisson));
  set.add(std::move(bending));
}

/// Finds the selections of a body, those of its surface among them.
struct Selector {
  const BodyConfig& config;
  const DeformableBody& body;
  std::span<const NamedVertices> of_surface;

  std::vector<int> operator()(const std::string& name) const {
    return select_vertices(config, name, body.mesh, body.positions, of_surface);
  }
};

void pin(const BodyConfig& config, const Selector& select, DeformableBody& body) {
  if (config.pinned.empty()) return;
  body.pinned.assign(body.positions.size(), 0);
  for (const auto& name : config.pinned)
    for (int v : select(name)) body.pinned[v] = 1;
}

void watch(const BodyConfig& config, const Selector& select, DeformableBody& body) {
  for (const auto& name : config.watch) body.watches.push_back({name, select(name)});
}

std::vector<Cord> make_cords(const CordConfig& given, const Selector& select) {
  const auto& body = select.body;
  const auto from = select(given.from);
  const auto to = given.to.empty() ? std::vector<int>{} : select(given.to);
  const auto mean_of = [&](const std::vector<int>& vertices) {
    Vec3 sum;
    for (int v : vertices) sum += body.positions[v];
    return sum / static_cast<double>(vertices.size());
  };
  std::vector<Cord> cords;
  const auto add = [&](std::vector<int> first, std::vector<int> second) {
    Cord cord{std::move(first), std::move(second), given.point.value_or(Vec3{}), given.stiffness, 0};
    const Vec3 end = cord.to.empty() ? cord.point : mean_of(cord.to);
    cord.rest_length = given.rest_length.value_or(given.rest_fraction * norm(end - mean_of(cord.from)));
    cords.push_back(std::move(cord));
  };
  if (given.ends == CordEnds::middle) return add(from, to), cords;
  for (int v : from) {
    if (to.empty()) {
      add({v}, {});
      continue;
    }
    const auto distance = [&](int w) { return norm(body.positions[w] - body.positions[v]); };
    const int nearest =
        *std::min_element(to.begin(), to.end(), [&](int a, int b) { return distance(a) < distance(b); });
    if (nearest != v) add({v}, {nearest});
  }
  return cords;
}

Attachments make_attachments(const BodyConfig& config, const Selector& select) {
  std::vector<Tether> tethers;
  for (const auto& given : config.tethers)
    for (int v : select(given.selection))
      tethers.push_back({v, select.body.positions[v], given.stiffness, given.damping});
  std::vector<Cord> cords;
  for (const auto& given : config.cords)
    for (auto& cord : make_cords(given, select)) cords.push_back(std::move(cord));
  std::vector<Pull> pulls;
  for (const auto& given : config.pulls) pulls.push_back({select(given.selection), given.force});
  Attachments attachments;
  if (!tethers.empty()) attachments.tethers = std::make_shared<const std::vector<Tether>>(std::move(tethers));
  if (!cords.empty()) attachments.cords = std::make_shared<const std::vector<Cord>>(std::move(cords));
  if (!pulls.empty()) attachments.pulls = std::make_shared<const std::vector<Pull>>(std::move(pulls));
  return attachments;
}

void find_rates(DeformableBody& body) {
  for (std::size_t v = 0; v < body.masses.size(); ++v) {
    if (body.masses[v] > 0 || body.is_pinned(v)) continue;
    body.largest_frequency = body.largest_damping_rate = std::numeric_limits<double>::infinity();
    return;
  }
  body.largest_frequency = find_largest_frequency(body);
  body.largest_damping_rate = find_largest_damping_rate(body, body.masses);
  if (!std::isfinite(body.largest_frequency) || !std::isfinite(body.largest_damping_rate))
    throw InputError(fmt::format(
        "body '{}': its fastest vibration is not a number; lower the stiffnesses of its potentials, or raise "
        "mass_per_vertex, by many orders of magnitude",
        body.name));
}

/// By force-spreading, told or chosen.
bool spreads_forces(const BodyConfig& config) {
  const bool massless = config.mass_per_vertex.value_or(0) == 0 && config.material.thickness == 0;
  return config.coupling == CouplingKind::force_spreading || (config.coupling == CouplingKind::automatic && massless);
}

/// Nothing of the body refers to where its vertices were.
bool is_interface(const BodyConfig& config, const DeformableBody& body) {
  const auto& given = config.potentials;
  const auto& by = body.attachments;
  return spreads_forces(config) && body.mesh.is_closed() && given.surface_tension &&
         given.surface_tension->mesh_control == 0 && !given.edge && !given.membrane && !given.bending && !given.area &&
         !config.material.young && config.inner_damping == 0 && body.pinned.empty() && !by.tethers && !by.cords &&
         !by.pulls;
}

}  // namespace

PotentialSet make_potentials(const BodyConfig& config, const TriangleMesh& mesh, std::span<const Vec3> reference) {
  const auto& given = config.potentials;
  PotentialSet set;
  add_in_plane(config, mesh, reference, set);
  add_bending(config, mesh, reference, set);
  if (given.volume) set.add(VolumePenalty{given.volume->stiffness, enclosed_volume(mesh, reference)});
  if (given.pressure) set.add(Pressure{given.pressure->value});
  if (given.area) set.add(FaceAreaPenalty{given.area->stiffness, face_areas(mesh, reference)});
  if (given.total_area) set.add(TotalAreaPenalty{given.total_area->stiffness, total_area(mesh, reference)});
  if (const auto& tension = given.surface_tension) {
    const bool by_default = tension->mesh_control == 0 && !spreads_forces(config);
    set.add(SurfaceTension{tension->sigma,
                           by_default ? SurfaceTension::balanced_control(tension->sigma) : tension->mesh_control});
  }
  return set;
}

std::vector<double> vertex_masses(const BodyConfig& config, std::span<const double> vertex_areas,
                                  double fluid_density) {
  std::vector<double> masses(vertex_areas.begin(), vertex_areas.end());
  const auto& material = config.material;
  const bool of_wall = !config.mass_per_vertex && material.thickness > 0;
  const double per_area = material.density.value_or(fluid_density) * material.thickness;
  for (double& mass : masses)
    mass = of_wall ? per_area * mass : config.mass_per_vertex.value_or(moves_by_newton(config.coupling) ? 1.0 : 0.0);
  return masses;
}

TractionConfig resolve(const TractionConfig& given, MotionKind motion, double mean_spacing) {
  TractionConfig traction = given;
  if (traction.form == TractionForm::automatic)
    traction.form = motion == MotionKind::deformable ? TractionForm::one_sided : TractionForm::quadratic;
  if (traction.probe_length <= 0)
    traction.probe_length = (traction.form == TractionForm::quadratic ? 1.5 : 1.0) * mean_spacing;
  return traction;
}

DeformableBody make_body(const BodyConfig& config, Surface surface, double mean_spacing, double fluid_density) {
  const std::size_t n = surface.positions.size();
  DeformableBody body;
  body.name = config.name;
  body.motion = config.motion;
  body.reference_areas = vertex_areas(surface.mesh, surface.positions);
  const double volume = enclosed_volume(surface.mesh, surface.positions);
  body.radius = std::cbrt(3.0 * volume / (4.0 * std::numbers::pi));
  body.potentials = make_potentials(config, surface.mesh, surface.positions);
  body.velocities.resize(n);
  body.forces.resize(n);
  body.masses = vertex_masses(config, body.reference_areas, fluid_density);
  body.damping = config.damping;
  body.inner_damping = config.inner_damping;
  body.traction = resolve(config.traction, config.motion, mean_spacing);
  body.substeps = config.substeps;
  body.reference = surface.positions;
  body.positions = std::move(surface.positions);
  body.mesh = std::move(surface.mesh);
  if (body.motion != MotionKind::deformable) return body;
  const Selector select{config, body, surface.selections};
  pin(config, select, body);
  watch(config, select, body);
  body.attachments = make_attachments(config, select);
  body.is_interface = is_interface(config, body);
  find_rates(body);
  return body;
}

}  // namespace pliant
