#include <fmt/format.h>

#include <memory>
#include <optional>
#include <vector>

#include "app/command.hpp"
#include "app/load_case.hpp"
#include "app/memory_estimate.hpp"
#include "app/output_name.hpp"
#include "simulation/simulation.hpp"
#include "simulation/wall_clock.hpp"

namespace pliant {
namespace {
struct RunArguments {
  CaseArguments input;
  std::string output;
  std::string end_time, max_steps;
  ProgressStyle progress = ProgressStyle::automatic;
  std::optional<std::string> restart;  // empty: the newest checkpoint
  std::string wall_clock;
};

int run(RunArguments arguments, const Communicator& ranks) {
  if (!arguments.end_time.empty()) arguments.input.overrides.push_back("time.end=" + arguments.end_time);
  if (!arguments.max_steps.empty()) arguments.input.overrides.push_back("time.max_steps=" + arguments.max_steps);
  const auto config = load_case(arguments.input, ranks);
  require_memory(config, ranks);
  SimulationOptions options;
  options.output = arguments.output.empty() ? default_output(config) : std::filesystem::path(arguments.output);
  options.progress = arguments.progress;
  if (arguments.restart) options.restart = RestartRequest{*arguments.restart};
  if (!arguments.wall_clock.empty()) options.wall_clock = parse_wall_clock(arguments.wall_clock);
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
  command
      ->add_option_function<std::vector<std::string>>(
          "--restart",
          [arguments](const std::vector<std::string>& values) {
            arguments->restart = values.empty() ? "" : values.front();
          },
          "Go on from a checkpoint; without FILE (then behind CASE) from the newest good one in the output folder")
      ->expected(0, 1)
      ->type_name("[FILE]");
  command->add_option("--wall-clock", arguments->wall_clock, "End with a checkpoint before this much time has passed")
      ->type_name("HH:MM[:SS]");
  command->add_flag_callback(
      "--quiet", [arguments] { arguments->progress = ProgressStyle::silent; }, "Show no progress");
  command->callback(
      [arguments, &action] { action = [arguments](const Communicator& ranks) { return run(*arguments, ranks); }; });
}

}  // namespace pliant
