#pragma once
#include "core/timer.hpp"
#include "parallel/communicator.hpp"

namespace pliant {

/// Of the phases that the root knows, the largest time of all ranks. Collective.
PhaseTimer::Seconds slowest_of(const Communicator& ranks, const PhaseTimer::Seconds& mine);

}  // namespace pliant
