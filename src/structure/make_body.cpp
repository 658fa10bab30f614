#include "structure/make_body.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "mesh/geometry.hpp"
#include "structure/stable_time_step.hpp"

namespace pliant {

PotentialSet make_potentials(const PotentialsConfig& config, const TriangleMesh& mesh,
                             std::span<const Vec3> reference) {
  PotentialSet set;
  if (config.edge) set.add(EdgeSprings::uniform(mesh, reference, config.edge->stiffness, config.edge->rest_length));
  if (config.bending)
    set.add(config.bending->reference == ReferenceAngle::initial
                ? Bending::about_shape(mesh, reference, config.bending->stiffness)
                : Bending::about_flat(mesh, config.bending->stiffness));
  if (config.volume) set.add(VolumePenalty{config.volume->stiffness, enclosed_volume(mesh, reference)});
  if (config.area) set.add(FaceAreaPenalty{config.area->stiffness, face_areas(mesh, reference)});
  if (config.total_area) set.add(TotalAreaPenalty{config.total_area->stiffness, total_area(mesh, reference)});
  if (const auto& tension = config.surface_tension) {
    const double control =
        tension->mesh_control > 0 ? tension->mesh_control : SurfaceTension::balanced_control(tension->sigma);
    set.add(SurfaceTension{tension->sigma, control});
  }
  return set;
}

TractionConfig resolve(const TractionConfig& given, MotionKind motion, double mean_spacing) {
  TractionConfig traction = given;
  if (traction.form == TractionForm::automatic)
    traction.form = motion == MotionKind::deformable ? TractionForm::one_sided : TractionForm::quadratic;
  if (traction.probe_length <= 0)
    traction.probe_length = (traction.form == TractionForm::quadratic ? 1.5 : 1.0) * mean_spacing;
  return traction;
}

DeformableBody make_body(const BodyConfig& config, Surface surface, double mean_spacing) {
  if (!(config.mass_per_vertex >= 0))
    throw InputError(
        fmt::format("body '{}': mass_per_vertex = {} must not be negative", config.name, config.mass_per_vertex));
  const std::size_t n = surface.positions.size();
  DeformableBody body;
  body.name = config.name;
  body.motion = config.motion;
  body.reference_areas = vertex_areas(surface.mesh, surface.positions);
  const double volume = enclosed_volume(surface.mesh, surface.positions);
  body.radius = std::cbrt(3.0 * volume / (4.0 * std::numbers::pi));
  body.potentials = make_potentials(config.potentials, surface.mesh, surface.positions);
  body.velocities.resize(n);
  body.forces.resize(n);
  body.masses.assign(n, config.mass_per_vertex);
  body.damping = config.damping;
  body.traction = resolve(config.traction, config.motion, mean_spacing);
  body.substeps = config.substeps;
  body.reference = surface.positions;
  body.positions = std::move(surface.positions);
  body.mesh = std::move(surface.mesh);
  if (body.motion != MotionKind::deformable || config.mass_per_vertex == 0) return body;
  body.largest_frequency = find_largest_frequency(body);
  if (!std::isfinite(body.largest_frequency))
    throw InputError(fmt::format(
        "body '{}': its fastest vibration is not a number; lower the stiffnesses of its potentials, or raise "
        "mass_per_vertex, by many orders of magnitude",
        body.name));
  return body;
}

}  // namespace pliant
