#pragma once
#include <set>
#include <string>
#include <vector>

#include "config/case_config.hpp"

namespace pliant {

/// Everything that is wrong with a case as a whole, each a full sentence with the place and what to do; empty when a
/// run on `ranks` ranks may start. Single values are checked as they are read. Checks that rest on a key in `suspect`
/// (already complained about) are skipped.
std::vector<std::string> validate(const CaseConfig& config, int ranks, const std::set<std::string>& suspect = {});

/// Whether a body that fills [lower, upper] fits into the box: inside every bounded side, and no longer than the box
/// along a periodic direction. Appends to `problems`. `index` is the body's place in config.bodies.
void check_body_extent(const CaseConfig& config, std::size_t index, Vec3 lower, Vec3 upper,
                       std::vector<std::string>& problems);

/// The same for one copy of a body, which goes by `place` in the messages.
void check_extent(const CaseConfig& config, const std::string& place, Vec3 lower, Vec3 upper,
                  std::vector<std::string>& problems);

/// "case.toml:12: body.drop" - where a key was set, and its name; the file alone for a default.
std::string place_of(const CaseConfig& config, const std::string& key);

/// The conditions at both ends of a direction (0, 1, 2).
bool is_periodic(const BoundaryConfig& boundary, int direction);
/// True if fluid may pass both sides of a direction that is not periodic.
bool is_open(const BoundaryConfig& boundary, int direction);
bool has_walls(const BoundaryConfig& boundary, int direction);

}  // namespace pliant
