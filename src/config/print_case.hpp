#pragma once
#include <string>

#include "config/case_config.hpp"
#include "config/value_codec.hpp"

namespace pliant {

/// The case with every default filled in, nested as in the case file: {"box": {"size": [...], ...}, "body": [...]}.
/// Keys that do not apply, and optional ones that are not set, are left out.
Json resolved_case(const CaseConfig& config);

/// resolved_case as a case file: reading it again gives the same case.
std::string to_toml(const CaseConfig& config);

}  // namespace pliant
