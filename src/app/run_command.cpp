#include <fmt/format.h>

#include <memory>
#include <optional>

#include "app/command.hpp"
#include "app/load_case.hpp"
#include "app/memory_estimate.hpp"
#include "app/output_name.hpp"
#include "simulation/simulation.hpp"

namespace pliant {
namespace {
struct RunArguments {
  CaseArguments input;
  std::string output;
  std::string end_time, max_steps;
  ProgressStyle progress = ProgressStyle::automatic;
};

int run(RunArguments arguments, const Communicator& ranks) {
  if (!arguments.end_time.empty()) arguments.input.overrides.push_back("time.end=" + arguments.end_time);
  if (!arguments.max_steps.empty()) arguments.input.overrides.push_back("time.max_steps=" + arguments.max_steps);
  const auto config = load_case(arguments.input, ranks);
  require_memory(config, ranks);
  SimulationOptions options;
  options.output = arguments.output.empty() ? default_output(config) : std::filesystem::path(arguments.output);
  options.progress = arguments.progress;
  Simulation simulation(config, ranks, options);
  return simulation.run().exit_code();
}
}  // namespace

void add_run_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<RunArguments>();
  auto* command = app.add_subcommand("run", "Run a case; under mpirun -n N on N ranks");
  add_case_arguments(*command, arguments->input);
  command->add_option("--out", arguments->output, "Folder for all outputs; default: out/ and the name of the case")
      ->type_name("DIR");
  command->add_option("--end-time", arguments->end_time, "End at this time; short for --set time.end=T")
      ->type_name("T");
  command->add_option("--max-steps", arguments->max_steps, "End after so many steps; short for --set time.max_steps=N")
      ->type_name("N");
  command->add_flag_callback(
      "--quiet", [arguments] { arguments->progress = ProgressStyle::silent; }, "Show no progress");
  command->callback(
      [arguments, &action] { action = [arguments](const Communicator& ranks) { return run(*arguments, ranks); }; });
}

}  // namespace pliant
