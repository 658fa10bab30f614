#include <map>
#include <memory>

#include "app/bench_command.hpp"
#include "app/bench_transfer.hpp"
#include "app/command.hpp"

namespace pliant {
namespace {
template <class Value>
CLI::Option* add_choice(CLI::App& app, const std::string& name, Value& value, const std::map<std::string, Value>& words,
                        const std::string& doc) {
  return app.add_option(name, value, doc)->transform(CLI::CheckedTransformer(words).description(""))->type_name("WORD");
}

/// What all of them take.
template <class Options>
void add_box(CLI::App& command, const std::shared_ptr<Options>& options) {
  command.add_option("--cells", options->cells, "Cells in x, y, z")->check(CLI::PositiveNumber);
  command.add_option("--repeats", options->repeats, "Timed repetitions; the median counts")->check(CLI::PositiveNumber);
  add_choice<StretchingLaw>(command, "--stretching", options->stretching,
                            {{"uniform", StretchingLaw::uniform}, {"tanh", StretchingLaw::tanh}},
                            "Spacing in z: uniform or tanh");
  add_choice<BenchBoundary>(command, "--boundary", options->boundary,
                            {{"periodic", BenchBoundary::periodic},
                             {"channel", BenchBoundary::channel},
                             {"closed", BenchBoundary::closed_box}},
                            "periodic, channel (walls in z) or closed (walls all around)");
  command.add_flag_callback(
      "--json", [options] { options->format = ReportFormat::json; }, "Print JSON");
}

void add_flow(CLI::App& command, Action& action) {
  auto options = std::make_shared<BenchOptions>();
  auto* flow = command.add_subcommand("flow", "Time steps of the flow solver alone");
  add_box(*flow, options);
  add_choice<ViscousMode>(*flow, "--viscous", options->viscous,
                          {{"explicit", ViscousMode::explicit_rk3},
                           {"implicit-z", ViscousMode::implicit_z},
                           {"implicit", ViscousMode::implicit}},
                          "explicit, implicit-z or implicit");
  add_choice<Sweeps>(*flow, "--sweeps", options->sweeps, {{"plain", Sweeps::plain}, {"fused", Sweeps::fused}},
                     "fused or plain, as time.sweeps of a case");
  flow->add_option("--steps", options->steps, "Steps in one timed repetition")->check(CLI::PositiveNumber);
  flow->callback([options, &action] { action = [options](const Communicator&) { return run_bench_flow(*options); }; });
}

void add_transfer(CLI::App& command, Action& action) {
  auto options = std::make_shared<TransferBenchOptions>();
  auto* transfer = command.add_subcommand("transfer", "Time the transfer between flow and markers");
  add_box(*transfer, options);
  transfer->add_option("--markers", options->markers, "Markers, on spheres of 1280 faces")
      ->check(CLI::Range(1, most_bench_markers));
  add_choice<MarkerOrder>(*transfer, "--order", options->order,
                          {{"natural", MarkerOrder::natural}, {"random", MarkerOrder::random}},
                          "How markers follow each other: natural (face after face) or random");
  transfer->callback(
      [options, &action] { action = [options](const Communicator&) { return run_bench_transfer(*options); }; });
}

}  // namespace

void add_bench_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("bench", "Measure speed");
  command->require_subcommand(1);
  add_flow(*command, action);
  add_transfer(*command, action);
}

}  // namespace pliant
