#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "parallel/communicator.hpp"

namespace pliant {

/// What the command line asked for; returns the exit code of the program. Collective over the ranks.
using Action = std::function<int(const Communicator&)>;

/// Each adds its subcommand to the command line; parsing it sets `action`.
void add_run_command(CLI::App& app, Action& action);
void add_check_command(CLI::App& app, Action& action);
void add_mesh_command(CLI::App& app, Action& action);
void add_calibrate_command(CLI::App& app, Action& action);
void add_bench_command(CLI::App& app, Action& action);
void add_reference_command(CLI::App& app, Action& action);

/// The case and its overrides, as several subcommands take them.
struct CaseArguments {
  std::string path;
  std::vector<std::string> overrides;
};
/// Adds CASE and --set to a subcommand.
void add_case_arguments(CLI::App& command, CaseArguments& arguments);

}  // namespace pliant
