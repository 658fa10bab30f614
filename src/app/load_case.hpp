#pragma once
#include "app/command.hpp"
#include "config/case_config.hpp"

namespace pliant {

/// Reads and validates a case with its overrides, and then the surfaces that it names: each must be readable, sound,
/// closed and inside the box. Throws InputError with every problem. Every rank reads; nothing is communicated.
CaseConfig load_case(const CaseArguments& arguments, int ranks);

}  // namespace pliant
