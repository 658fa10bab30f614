#pragma once
#include <string>

#include "coupling/body.hpp"

namespace pliant {

/// A line about a kind of body for people: its mesh and markers, how it moves and is coupled, and why so.
std::string describe(const BodyKind& kind, long copies);

}  // namespace pliant
