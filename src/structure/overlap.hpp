#pragma once
#include <span>
#include <string>
#include <vector>

#include "config/case_config.hpp"
#include "structure/place_bodies.hpp"

namespace pliant {

/// Every pair of bodies (copies included, periodic images as well) whose surfaces cross, or of which one lies inside
/// the other, and every file's surface that crosses itself: each a sentence that names the bodies, says where and what
/// to do. Bodies that only touch, to one part in a million of their size, do not overlap. At most `limit` are spelt
/// out; one more line counts the rest. `bodies` belongs to config.bodies.
std::vector<std::string> find_overlaps(const CaseConfig& config, std::span<const PlacedBody> bodies,
                                       std::size_t limit = 20);

}  // namespace pliant
