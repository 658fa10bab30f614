#include "app/memory_estimate.hpp"

#include <mpi.h>

#include <algorithm>

#include "flow/flow_solver.hpp"

namespace pliant {
namespace {
double slab_bytes(const CaseConfig& config, int planes) {
  auto box = config.box;
  box.cells[2] = planes;
  const Grid grid(box, config.boundary, Communicator(MPI_COMM_SELF));
  FlowParameters parameters;
  parameters.density = config.fluid.density;
  parameters.viscosity = config.fluid.viscosity / config.fluid.density;
  parameters.viscous = config.time.viscous;
  parameters.boundary = config.boundary;
  return static_cast<double>(FlowSolver(grid, parameters).bytes());
}
}  // namespace

MemoryEstimate estimate_memory(const CaseConfig& config, int ranks) {
  constexpr int thin = 4, thick = 8;
  MemoryEstimate estimate;
  estimate.planes = (config.box.cells[2] + ranks - 1) / ranks;
  if (estimate.planes <= thick) {
    estimate.flow_bytes = slab_bytes(config, estimate.planes);
  } else {
    const double first = slab_bytes(config, thin), second = slab_bytes(config, thick);
    const double per_plane = (second - first) / (thick - thin);
    estimate.flow_bytes = second + per_plane * (estimate.planes - thick);
  }
  const double cells = 1.0 * config.box.cells[0] * config.box.cells[1] * estimate.planes;
  estimate.doubles_per_cell = estimate.flow_bytes / (8 * cells);
  return estimate;
}

}  // namespace pliant
