#pragma once
#include <string>
#include <vector>

#include "config/case_config.hpp"
#include "coupling/body.hpp"
#include "grid/grid.hpp"

namespace pliant {

/// Lines for people: the dimensionless groups of a case, by the length 1 and the fastest velocity that the case
/// prescribes (1 if it prescribes none, or has [units]).
std::vector<std::string> dimensionless_groups(const CaseConfig& config, const Grid& grid,
                                              const std::vector<BodyKind>& kinds);

/// What the case's own units are, and its spacing, step and end in SI; empty without [units].
std::vector<std::string> physical_sizes(const CaseConfig& config, const Grid& grid, double step);

/// The largest and smallest values of every signal, where they are, and what it carries in a period.
std::vector<std::string> describe_signals(const CaseConfig& config);

/// "0.347 mm": a number in SI with the prefix that suits it.
std::string with_prefix(double value, const std::string& unit);

}  // namespace pliant
