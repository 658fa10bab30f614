#pragma once
#include <cstddef>

#include "config/case_config.hpp"

namespace pliant {

struct MemoryEstimate {
  double flow_bytes = 0;        ///< of the rank with most planes
  double doubles_per_cell = 0;  ///< flow_bytes over its cells
  int planes = 0;               ///< of that rank
};

/// Memory of the flow solver on the fullest of `ranks` ranks. Two thin slabs of the same width are built and
/// extrapolated to the true number of planes, so that a large case can be checked on a small machine.
MemoryEstimate estimate_memory(const CaseConfig& config, int ranks);

}  // namespace pliant
