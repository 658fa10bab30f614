#pragma once
#include <set>
#include <string>
#include <vector>

#include "config/case_config.hpp"

namespace pliant {

/// What is wrong with outputs that go by phases, and with cavities; appends to `problems` in the manner of validate().
void check_outputs(const CaseConfig& config, const std::set<std::string>& suspect, std::vector<std::string>& problems);

}  // namespace pliant
