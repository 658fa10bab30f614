#pragma once
#include "coupling/body.hpp"
#include "grid/grid.hpp"
#include "mesh/surface.hpp"

namespace pliant {

/// A [[body]] of the case with its shape (place_bodies has it), ready to be copied: markers, mass, motion, coupling.
/// Throws InputError with every problem.
BodyKind make_body_kind(const CaseConfig& config, std::size_t index, Surface shape, const Grid& grid);

}  // namespace pliant
