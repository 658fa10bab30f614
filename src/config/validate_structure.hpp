#pragma once
#include <set>
#include <string>
#include <vector>

#include "config/case_config.hpp"

namespace pliant {

/// What keys of deformable bodies demand of each other: material, selections and what refers to them. Appends problems;
/// keys in `suspect` have been complained about.
void check_structures(const CaseConfig& config, const std::set<std::string>& suspect,
                      std::vector<std::string>& problems);

}  // namespace pliant
