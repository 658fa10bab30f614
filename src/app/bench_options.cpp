#include <map>
#include <memory>

#include "app/bench_command.hpp"
#include "app/command.hpp"

namespace pliant {
namespace {
template <class Value>
CLI::Option* add_choice(CLI::App& app, const std::string& name, Value& value, const std::map<std::string, Value>& words,
                        const std::string& doc) {
  return app.add_option(name, value, doc)->transform(CLI::CheckedTransformer(words).description(""))->type_name("WORD");
}
}  // namespace

void add_bench_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<BenchOptions>();
  auto* command = app.add_subcommand("bench", "Measure speed");
  command->require_subcommand(1);
  auto* flow = command->add_subcommand("flow", "Time steps of the flow solver alone");
  flow->add_option("--cells", options->cells, "Cells in x, y, z")->check(CLI::PositiveNumber);
  add_choice<ViscousMode>(*flow, "--viscous", options->viscous,
                          {{"explicit", ViscousMode::explicit_rk3},
                           {"implicit-z", ViscousMode::implicit_z},
                           {"implicit", ViscousMode::implicit}},
                          "explicit, implicit-z or implicit");
  flow->add_option("--steps", options->steps, "Steps in one timed repetition")->check(CLI::PositiveNumber);
  flow->add_option("--repeats", options->repeats, "Timed repetitions; the median counts")->check(CLI::PositiveNumber);
  add_choice<StretchingLaw>(*flow, "--stretching", options->stretching,
                            {{"uniform", StretchingLaw::uniform}, {"tanh", StretchingLaw::tanh}},
                            "Spacing in z: uniform or tanh");
  add_choice<BenchBoundary>(*flow, "--boundary", options->boundary,
                            {{"periodic", BenchBoundary::periodic},
                             {"channel", BenchBoundary::channel},
                             {"closed", BenchBoundary::closed_box}},
                            "periodic, channel (walls in z) or closed (walls all around)");
  flow->add_flag_callback(
      "--json", [options] { options->format = ReportFormat::json; }, "Print JSON");
  flow->callback([options, &action] { action = [options](const Communicator&) { return run_bench_flow(*options); }; });
}

}  // namespace pliant
