#pragma once
#include <filesystem>

#include "config/case_config.hpp"
#include "mesh/surface.hpp"
#include "structure/deformable_body.hpp"

namespace pliant {

/// What a body's configuration leaves to its surroundings.
struct BodySetting {
  std::filesystem::path folder;  ///< files of surfaces start here
  double mean_spacing = 0;       ///< of the grid; the probe length where none is given
};

/// The body at rest in its reference shape, with its potentials; constants are taken as they are (per edge, per hinge).
/// Finds the largest frequency of its internal forces. Throws InputError.
DeformableBody make_body(const BodyConfig& config, const BodySetting& setting);

/// The traction with what the case leaves open filled in: form and probe length.
TractionConfig resolve(const TractionConfig& given, MotionKind motion, double mean_spacing);

/// Potentials of the configuration about a reference shape.
PotentialSet make_potentials(const PotentialsConfig& config, const TriangleMesh& mesh, std::span<const Vec3> reference);

}  // namespace pliant
