#pragma once
#include "parallel/communicator.hpp"

namespace pliant {

/// Memory speed of all ranks together in GB/s by the STREAM triad a = b + s c on arrays far larger than the last-level
/// cache, counted as 24 bytes an element. The median of several passes. Collective.
double triad_speed(const Communicator& ranks);

}  // namespace pliant
