#pragma once
#include <set>
#include <string>
#include <vector>

#include "config/case_config.hpp"

namespace pliant {

/// What is wrong with how bodies move, are coupled, loaded and kept apart, as far as the case alone can tell. `suspect`
/// as in validate.
void check_motions(const CaseConfig& config, const std::set<std::string>& suspect, std::vector<std::string>& problems);

}  // namespace pliant
