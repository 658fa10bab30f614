#pragma once
#include <string>
#include <vector>

#include "config/case_config.hpp"
#include "config/value_codec.hpp"

namespace pliant {

/// What makes a case the same case to a checkpoint of it: every key with its default filled in, and the contents of the
/// files of surfaces, positions and signals. Left out is what may change when a run continues: the title, [output],
/// [checkpoint], and of [time] the end, max_steps, step, cfl and max_step. Throws RunError if such a file cannot be
/// read.
Json case_identity(const CaseConfig& config);

/// Each difference as a sentence without a full stop that names the key and both values; empty: the same case.
std::vector<std::string> differences(const Json& in_case, const Json& in_checkpoint);

}  // namespace pliant
