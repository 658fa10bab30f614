#include "app/bench_transfer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>

#include "app/transfer_trial.hpp"
#include "app/triad.hpp"
#include "core/error.hpp"
#include "core/version.hpp"

namespace pliant {
namespace {

constexpr int fewest_cells = 3;  // as many as a stencil has nodes

struct Part {
  const char* key;
  const char* text;
  void (TransferTrial::*work)();
};

constexpr Part closed_step{"step", "one full step", &TransferTrial::step};
constexpr Part generic_step{"step_generic", "the same by plain 4 x 4 solves", &TransferTrial::step_by_plain_solves};
constexpr Part lean_step{"step_generic_lean", "the same by lean 4 x 4 solves", &TransferTrial::step_by_lean_solves};
constexpr Part pieces[] = {
    {"stencil", "six stencils", &TransferTrial::make_stencils},
    {"interpolation", "interpolation of a vector", &TransferTrial::interpolate_velocity},
    {"spreading", "spreading of a vector", &TransferTrial::spread_force},
    {"probe", "probe of p and nine gradients", &TransferTrial::probe_flow},
    {"placing", "sorting and weighing anew", &TransferTrial::place_markers},
    {"step_of_run", "a step with all that a run does", &TransferTrial::step_of_run},
};

using Times = std::vector<double>;  // ns a marker, of each repetition

struct Spread {
  double median, smallest, largest;
};

Spread spread_of(Times times) {
  std::sort(times.begin(), times.end());
  return {times[times.size() / 2], times.front(), times.back()};
}

void require_room(const TransferBenchOptions& options) {
  std::vector<std::string> problems;
  for (std::size_t d = 0; d < 3; ++d)
    if (options.cells[d] < fewest_cells)
      problems.push_back(fmt::format("--cells: {} along {} are too few for markers: give at least {}", options.cells[d],
                                     "xyz"[d], fewest_cells));
  if (!problems.empty()) throw InputError(std::move(problems));
}

Grid grid_of(const TransferBenchOptions& options, const Communicator& ranks) {
  BoxConfig box;
  box.cells = options.cells;
  for (std::size_t d = 0; d < 3; ++d) box.size[static_cast<int>(d)] = options.cells[d];
  box.stretching_z.law = options.stretching;
  return Grid(box, sides_of(options.boundary), ranks);
}

class Stopwatch {
 public:
  Stopwatch(const Communicator& ranks, int markers)
      : ranks_(ranks), markers_(markers), passes_(std::max(1, enough_markers / markers)) {}

  /// Does the work as often as it takes to be measurable. Processor time, because none of it is waiting: what else runs
  /// on the machine counts less.
  double ns_per_marker(TransferTrial& trial, const Part& part) const {
    ranks_.barrier();
    const std::clock_t start = std::clock();
    for (int pass = 0; pass < passes_; ++pass) (trial.*part.work)();
    const double mine = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    return 1e9 * ranks_.max(mine) / passes_ / markers_;
  }

 private:
  static constexpr int enough_markers = 100'000;
  const Communicator& ranks_;
  int markers_, passes_;
};

struct Report {
  Times closed, generic, lean, ratio;
  std::vector<Times> of_piece{std::size(pieces)};
  double difference = 0, triad_before = 0, triad_after = 0;
};

Report measure(const TransferBenchOptions& options, const Communicator& ranks) {
  const Grid grid = grid_of(options, ranks);
  TransferTrial trial(grid, make_bench_markers(grid, options.markers, options.order));
  const Stopwatch watch(ranks, options.markers);
  Report report;
  report.triad_before = triad_speed(ranks);
  for (const Part& part : pieces) (trial.*part.work)();  // touches all memory
  for (int r = 0; r < options.repeats; ++r) {
    report.closed.push_back(watch.ns_per_marker(trial, closed_step));
    report.generic.push_back(watch.ns_per_marker(trial, generic_step));
    report.lean.push_back(watch.ns_per_marker(trial, lean_step));
    report.ratio.push_back(report.generic.back() / report.closed.back());
    for (std::size_t p = 0; p < std::size(pieces); ++p)
      report.of_piece[p].push_back(watch.ns_per_marker(trial, pieces[p]));
  }
  report.triad_after = triad_speed(ranks);
  trial.step();
  for (const Part& part : {generic_step, lean_step}) {
    (trial.*part.work)();
    report.difference = std::max(report.difference, trial.largest_difference());
  }
  return report;
}

nlohmann::ordered_json to_json(const Times& times) {
  const auto s = spread_of(times);
  return {{"median", s.median}, {"min", s.smallest}, {"max", s.largest}};
}

void print_json(const TransferBenchOptions& options, const Communicator& ranks, const Report& report) {
  nlohmann::ordered_json json;
  json["markers"] = options.markers;
  json["cells"] = options.cells;
  json["order"] = options.order == MarkerOrder::natural ? "natural" : "random";
  json["ranks"] = ranks.size();
  json["repeats"] = options.repeats;
  const auto put = [&](const std::string& key, const Times& times) {
    const auto spread = spread_of(times);
    json[key] = spread.median;
    json[key + "_min"] = spread.smallest;
    json[key + "_max"] = spread.largest;
  };
  put("ns_per_marker_step", report.closed);
  put("ns_per_marker_step_generic", report.generic);
  put("ns_per_marker_step_generic_lean", report.lean);
  put("generic_over_closed", report.ratio);
  for (std::size_t p = 0; p < std::size(pieces); ++p)
    json["ns_per_marker"][pieces[p].key] = to_json(report.of_piece[p]);
  json["largest_difference"] = report.difference;
  json["triad_gb_per_s_before"] = report.triad_before;
  json["triad_gb_per_s_after"] = report.triad_after;
  json["compiler"] = build_info().compiler;
  json["flags"] = build_info().flags;
  fmt::print("{}\n", json.dump(2));
}

void print_text(const TransferBenchOptions& options, const Communicator& ranks, const Report& report) {
  fmt::print("{} markers in {} x {} x {} cells, {} rank{}: ns a marker, median (range) of {} repeats\n",
             options.markers, options.cells[0], options.cells[1], options.cells[2], ranks.size(),
             ranks.size() == 1 ? "" : "s", options.repeats);
  const auto line = [](const Part& part, const Times& times) {
    const auto s = spread_of(times);
    fmt::print("  {:<32} {:7.0f} ({:.0f}-{:.0f})\n", part.text, s.median, s.smallest, s.largest);
  };
  line(closed_step, report.closed);
  line(generic_step, report.generic);
  line(lean_step, report.lean);
  const auto ratio = spread_of(report.ratio);
  fmt::print("  {:<32} {:7.1f} ({:.1f}-{:.1f})\n", "plain solves over closed form", ratio.median, ratio.smallest,
             ratio.largest);
  for (std::size_t p = 0; p < std::size(pieces); ++p) line(pieces[p], report.of_piece[p]);
  fmt::print("results differ by {:.1e} of the largest value; triad {:.1f} and {:.1f} GB/s\n", report.difference,
             report.triad_before, report.triad_after);
}

}  // namespace

int run_bench_transfer(const TransferBenchOptions& options) {
  require_room(options);
  const Communicator ranks;
  const Report report = measure(options, ranks);
  if (!ranks.is_root()) return exit_success;
  if (options.format == ReportFormat::json) print_json(options, ranks, report);
  else print_text(options, ranks, report);
  return exit_success;
}

}  // namespace pliant
