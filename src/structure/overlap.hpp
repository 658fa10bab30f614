#pragma once
#include <span>
#include <string>
#include <vector>

#include "config/case_config.hpp"
#include "mesh/surface_data.hpp"
#include "structure/place_bodies.hpp"

namespace pliant {

/// Every pair of bodies (copies included, periodic images as well) whose surfaces cross, or of which one lies inside
/// the other, and every surface, from a file or of a natural valve, that crosses itself: each a sentence that names the
/// bodies, says where and what to do. Bodies that only touch, to one part in a million of their size, do not overlap.
/// At most `limit` are spelt out; one more line counts the rest. `bodies` belongs to config.bodies. The faces that are
/// in each other's way, of the overlaps that are spelt out, are added to `picture` at their places; of a body inside
/// another, all.
std::vector<std::string> find_overlaps(const CaseConfig& config, std::span<const PlacedBody> bodies,
                                       std::size_t limit = 20, SurfaceData* picture = nullptr);

}  // namespace pliant
