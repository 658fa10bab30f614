#pragma once
#include "app/command.hpp"
#include "config/case_config.hpp"

namespace pliant {

/// Reads and validates a case with its overrides, and then its bodies: each surface must be readable, sound, in one
/// piece and closed (or open, where that is said), each copy inside the box, and none may overlap another. Throws
/// InputError with every problem. Every rank reads; nothing is communicated.
CaseConfig load_case(const CaseArguments& arguments, int ranks);

/// The same on all ranks of a run. What only some of them find (a file that is missing on one machine) becomes the
/// InputError of all, so that none waits for the others. Collective.
CaseConfig load_case(const CaseArguments& arguments, const Communicator& ranks);

}  // namespace pliant
