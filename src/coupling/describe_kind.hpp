#pragma once
#include <string>
#include <vector>

#include "coupling/bodies.hpp"
#include "grid/grid.hpp"

namespace pliant {

/// A line about a kind of body for people: its mesh and markers, how it moves and is coupled, and why so.
std::string describe(const BodyKind& kind, long copies);

/// What is likely to go wrong with a deformable body that acts on the flow, and what to do about it; for a fluid step
/// of `step`. Empty for all others.
std::vector<std::string> foresee(const BodyKind& kind, const Grid& grid, double step);

/// A line about what the scheme did to the deformable bodies of each kind that act on the flow, at the end of a run:
/// volume given back and slip. Collective; the same on all ranks.
std::vector<std::string> summarize(const Bodies& bodies);

}  // namespace pliant
