#pragma once
#include <cstddef>

#include "config/case_config.hpp"
#include "parallel/communicator.hpp"

namespace pliant {

struct MemoryEstimate {
  double flow_bytes = 0;        ///< of the rank with most planes
  double doubles_per_cell = 0;  ///< flow_bytes over its cells
  int planes = 0;               ///< of that rank
};

/// Memory of the flow solver, and of the state kept for checkpoints, on the fullest of `ranks` ranks. Small boxes are
/// built and extrapolated to the true numbers of cells, so that a large case can be checked on a small machine.
MemoryEstimate estimate_memory(const CaseConfig& config, int ranks);

/// Memory of a body on every rank, roughly.
double estimate_body_bytes(int n_vertices);

/// Throws InputError, on all ranks, if the flow alone is certain not to fit into the memory of a machine that some of
/// the ranks share. Collective.
void require_memory(const CaseConfig& config, const Communicator& ranks);

}  // namespace pliant
