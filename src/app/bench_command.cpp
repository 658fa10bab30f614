#include "app/bench_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/triad.hpp"
#include "core/error.hpp"
#include "core/version.hpp"
#include "flow/flow_solver.hpp"

namespace pliant {
namespace {

const char* word_of(ViscousMode mode) {
  switch (mode) {
    case ViscousMode::explicit_rk3:
      return "explicit";
    case ViscousMode::implicit_z:
      return "implicit-z";
    case ViscousMode::implicit:
      return "implicit";
  }
  return "";
}

struct Timing {
  Sweeps sweeps;
  std::vector<double> seconds_per_step;  // of each repetition, the slowest rank
  std::map<std::string, double> phase_share;
  double bytes_per_cell = 0, divergence = 0;
  std::vector<double> messages, bytes;  // sent in a substep, by rank
};

Timing time_steps(const BenchOptions& options, const Communicator& ranks) {
  BoxConfig box;
  box.cells = options.cells;
  box.size = {4, 2, 1};
  box.stretching_z.law = options.stretching;
  FlowParameters parameters;
  parameters.boundary = sides_of(options.boundary);
  parameters.viscosity = 1e-4;
  parameters.viscous = options.viscous;
  parameters.sweeps = options.sweeps;
  const Grid grid(box, parameters.boundary, ranks);
  FlowSolver solver(grid, parameters);
  InitialConfig initial;
  initial.flow = InitialFlow::perturbed;
  initial.velocity = {1, 0, 0};
  initial.amplitude = 0.1;
  set_initial_flow(solver, initial);
  const double dt = std::min(0.5 / solver.convective_rate(), 0.5 * solver.viscous_step_limit());
  solver.advance(dt);  // touches all memory and factorises
  solver.timer().reset();

  Timing timing;
  const Traffic before = grid.ranks().traffic();
  for (int r = 0; r < options.repeats; ++r) {
    ranks.barrier();
    const auto start = std::chrono::steady_clock::now();
    for (int n = 0; n < options.steps; ++n) solver.advance(dt);
    const double mine = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    timing.seconds_per_step.push_back(ranks.max(mine) / options.steps);
  }
  const Traffic after = grid.ranks().traffic();
  const double substeps = 3.0 * options.steps * options.repeats;
  const auto of_all = [&](long mine) {
    std::vector<double> values(static_cast<std::size_t>(ranks.size()));
    values[static_cast<std::size_t>(ranks.rank())] = static_cast<double>(mine) / substeps;
    ranks.sum(values);
    return values;
  };
  timing.messages = of_all(after.messages - before.messages);
  timing.bytes = of_all(after.bytes - before.bytes);
  double total = 0;
  for (const auto& [phase, seconds] : solver.timer().seconds()) total += timing.phase_share[phase] = ranks.max(seconds);
  for (auto& [phase, share] : timing.phase_share) share /= total;
  const double cells = 1.0 * options.cells[0] * options.cells[1] * options.cells[2];
  timing.bytes_per_cell = ranks.sum(static_cast<double>(solver.bytes())) / cells;
  timing.sweeps = sweeps_in_use(options.sweeps, options.cells[2], grid.is_periodic(2), ranks.size());
  timing.divergence = solver.largest_divergence();
  return timing;
}

}  // namespace

BoundaryConfig sides_of(BenchBoundary boundary) {
  BoundaryConfig sides;
  for (std::size_t s = 0; s < 6; ++s)
    if (boundary == BenchBoundary::closed_box || (boundary == BenchBoundary::channel && s >= 4)) sides[s] = WallSide{};
  return sides;
}

int run_bench_flow(const BenchOptions& options) {
  const Communicator ranks;
  const double triad_before = triad_speed(ranks);
  const Timing timing = time_steps(options, ranks);
  const double triad_after = triad_speed(ranks);
  if (!ranks.is_root()) return exit_success;

  std::vector<double> sorted = timing.seconds_per_step;
  std::sort(sorted.begin(), sorted.end());
  const double cells = 1.0 * options.cells[0] * options.cells[1] * options.cells[2];
  const auto ns = [&](double seconds) { return 1e9 * seconds / cells; };
  const double median = ns(sorted[sorted.size() / 2]);
  const double triad = 0.5 * (triad_before + triad_after);
  const double doubles = median * triad / 8;

  const auto largest = [](const std::vector<double>& values) {
    return *std::max_element(values.begin(), values.end());
  };
  const char* sweeps = timing.sweeps == Sweeps::fused ? "fused" : "plain";

  if (options.format == ReportFormat::json) {
    nlohmann::ordered_json report;
    report["cells"] = options.cells;
    report["viscous"] = word_of(options.viscous);
    report["ranks"] = ranks.size();
    report["steps"] = options.steps;
    report["repeats"] = options.repeats;
    report["ns_per_cell_step"] = median;
    report["ns_per_cell_step_min"] = ns(sorted.front());
    report["ns_per_cell_step_max"] = ns(sorted.back());
    report["triad_gb_per_s"] = triad;
    report["triad_gb_per_s_before"] = triad_before;
    report["triad_gb_per_s_after"] = triad_after;
    report["doubles_per_cell_step"] = doubles;
    report["bytes_per_cell"] = timing.bytes_per_cell;
    report["largest_divergence"] = timing.divergence;
    report["phase_share"] = timing.phase_share;
    report["messages_per_substep"] = timing.messages;
    report["bytes_per_substep"] = timing.bytes;
    report["sweeps"] = sweeps;
    report["compiler"] = build_info().compiler;
    report["flags"] = build_info().flags;
    fmt::print("{}\n", report.dump(2));
    return exit_success;
  }
  fmt::print(
      "{} x {} x {} cells, {}, {} sweeps, {} rank{}: {:.1f} ns a cell and step ({:.1f} to {:.1f} over {} repeats)\n",
      options.cells[0], options.cells[1], options.cells[2], word_of(options.viscous), sweeps, ranks.size(),
      ranks.size() == 1 ? "" : "s", median, ns(sorted.front()), ns(sorted.back()), options.repeats);
  fmt::print("triad {:.1f} GB/s (before {:.1f}, after {:.1f}): {:.0f} doubles a cell and step, {:.0f} bytes a cell\n",
             triad, triad_before, triad_after, doubles, timing.bytes_per_cell);
  if (ranks.size() > 1)
    fmt::print("a rank sends at most {:.0f} messages and {:.4g} MB in a substep\n", largest(timing.messages),
               largest(timing.bytes) / 1e6);
  for (const auto& [phase, share] : timing.phase_share) fmt::print("  {:<28} {:5.1f} %\n", phase, 100 * share);
  return exit_success;
}

}  // namespace pliant
