#pragma once
#include <string>

namespace pliant {

/// docs/case-reference.md: every key with type, unit, default, legal values and what it is, from the table of keys.
std::string case_reference();

}  // namespace pliant
