#pragma once
#include "config/case_config.hpp"
#include "mesh/surface.hpp"
#include "structure/deformable_body.hpp"

namespace pliant {

/// The body at rest in its reference shape, `surface`, with its potentials; constants are taken as they are (per edge,
/// per hinge). `mean_spacing` of the grid: the probe length where none is given. Finds the largest frequency of its
/// internal forces. Throws InputError.
DeformableBody make_body(const BodyConfig& config, Surface surface, double mean_spacing);

/// The traction with what the case leaves open filled in: form and probe length.
TractionConfig resolve(const TractionConfig& given, MotionKind motion, double mean_spacing);

/// Potentials of the configuration about a reference shape.
PotentialSet make_potentials(const PotentialsConfig& config, const TriangleMesh& mesh, std::span<const Vec3> reference);

}  // namespace pliant
