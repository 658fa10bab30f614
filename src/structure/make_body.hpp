#pragma once
#include "config/case_config.hpp"
#include "mesh/surface.hpp"
#include "structure/deformable_body.hpp"

namespace pliant {

/// The body at rest in its reference shape, `surface`, with its potentials; constants are taken as they are (per edge,
/// per hinge), or made from the material. `mean_spacing` of the grid: the probe length where none is given;
/// `fluid_density`: the density of its wall where none is given. Finds the largest frequency and damping rate of its
/// internal forces, unless a vertex has no mass: then both are infinite. Throws InputError.
DeformableBody make_body(const BodyConfig& config, Surface surface, double mean_spacing, double fluid_density);

/// The traction with what the case leaves open filled in: form and probe length.
TractionConfig resolve(const TractionConfig& given, MotionKind motion, double mean_spacing);

/// Potentials of the configuration about a reference shape: those that are given, and for the rest those of the
/// material.
PotentialSet make_potentials(const BodyConfig& config, const TriangleMesh& mesh, std::span<const Vec3> reference);

/// What the wall of a body weighs at each vertex, or mass_per_vertex.
std::vector<double> vertex_masses(const BodyConfig& config, std::span<const double> vertex_areas, double fluid_density);

}  // namespace pliant
