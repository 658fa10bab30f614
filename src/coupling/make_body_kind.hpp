#pragma once
#include "coupling/body.hpp"
#include "grid/grid.hpp"

namespace pliant {

/// A [[body]] of the case, ready to be copied: surface, markers, mass, motion, coupling. Throws InputError with every
/// problem.
BodyKind make_body_kind(const CaseConfig& config, std::size_t index, const Grid& grid);

}  // namespace pliant
