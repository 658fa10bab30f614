#include "app/memory_estimate.hpp"

#include <fmt/format.h>
#include <mpi.h>
#include <unistd.h>

#include <array>
#include <cmath>

#include "config/validate.hpp"
#include "core/error.hpp"
#include "flow/flow_solver.hpp"
#include "simulation/phase_average.hpp"

namespace pliant {
namespace {
using Cells = std::array<int, 3>;

double slab_bytes(const CaseConfig& config, const Cells& cells) {
  auto box = config.box;
  box.cells = cells;
  const Grid grid(box, config.boundary, Communicator(MPI_COMM_SELF));
  FlowParameters parameters;
  parameters.density = config.fluid.density;
  parameters.viscosity = config.fluid.viscosity / config.fluid.density;
  parameters.viscous = config.time.viscous;
  parameters.sweeps = config.time.sweeps;
  parameters.boundary = config.boundary;
  // What varies along the sides takes next to nothing, and patches need not fit the small grids tried here.
  for (auto& side : parameters.boundary) {
    if (auto* patches = patches_of(side)) patches->clear();
    if (auto* inflow = std::get_if<InflowSide>(&side)) inflow->signal.clear();
  }
  return static_cast<double>(FlowSolver(grid, parameters).bytes());
}

// Every array is a product of lengths that grow with the cells of one direction each, so the sum is linear in each of
// the three numbers of cells: two small numbers a direction tell the rest.
double extrapolated_bytes(const CaseConfig& config, Cells cells, std::size_t direction) {
  constexpr Cells small{32, 32, 4}, large{64, 64, 8};
  if (direction == 3) return slab_bytes(config, cells);
  const int n = cells[direction];
  if (n <= large[direction]) return extrapolated_bytes(config, cells, direction + 1);
  const auto bytes_at = [&](int count) {
    cells[direction] = count;
    return extrapolated_bytes(config, cells, direction + 1);
  };
  const double first = bytes_at(small[direction]), second = bytes_at(large[direction]);
  const double slope = (second - first) / (large[direction] - small[direction]);
  return second + slope * (n - large[direction]);
}
}  // namespace

MemoryEstimate estimate_memory(const CaseConfig& config, int ranks) {
  MemoryEstimate estimate;
  auto cells = config.box.cells;
  estimate.planes = cells[2] = (cells[2] + ranks - 1) / ranks;
  estimate.flow_bytes = extrapolated_bytes(config, cells, 0);
  const double field_bytes = 8.0 * cells[0] * cells[1] * cells[2];
  // The state that a run keeps in memory for the checkpoint of a failure.
  if (config.checkpoint.keep > 0) estimate.flow_bytes += 4 * field_bytes;
  for (const auto& body : config.bodies)
    if (body.tight)
      estimate.flow_bytes +=
          field_bytes * static_cast<double>(1 + body.tight_parts.size()) * body.placement.count.value_or(1);
  estimate.flow_bytes += phase_average_bytes_per_cell(config.output) * cells[0] * cells[1] * cells[2];
  estimate.doubles_per_cell = estimate.flow_bytes / (8.0 * cells[0] * cells[1] * cells[2]);
  return estimate;
}

double estimate_body_bytes(int n_vertices) {
  // A closed surface has two faces and three edges a vertex. Bytes a vertex: the mesh 200, the state 110, all
  // potentials 140, loads and shape 120, samples of the flow 230 to 460 (probes on faces), the copy for the output 24.
  constexpr double bytes_per_vertex = 1000;
  return bytes_per_vertex * n_vertices;
}

void require_memory(const CaseConfig& config, const Communicator& ranks) {
  MPI_Comm node = MPI_COMM_NULL;
  check_mpi(MPI_Comm_split_type(ranks.handle(), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node), "MPI_Comm_split_type");
  const int ranks_here = Communicator(node).size();
  check_mpi(MPI_Comm_free(&node), "MPI_Comm_free");
  // Whole fields: plain sweeps keep the predicted velocity beside the state.
  const double least_doubles_per_cell = config.time.sweeps == Sweeps::fused ? 8 : 11;
  const auto& n = config.box.cells;
  const double planes = std::ceil(static_cast<double>(n[2]) / ranks.size());
  const double averages = phase_average_bytes_per_cell(config.output);
  const double needed = (8 * least_doubles_per_cell + averages) * n[0] * n[1] * planes * ranks_here;
  const double present = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  const double excess = ranks.max(present > 0 ? needed / present : 0.0);
  if (excess <= 1) return;
  throw InputError(fmt::format(
      "{} {} x {} x {} needs at least {:.4g} GB on one machine, {:.3g} times the memory that it has; use "
      "fewer cells{}, or more machines",
      place_of(config, "box.cells"), n[0], n[1], n[2], needed / 1e9, excess,
      averages > 0 ? fmt::format(", fewer bins of output.phase_average ({:.0f} bytes a cell)", averages) : ""));
}

}  // namespace pliant
