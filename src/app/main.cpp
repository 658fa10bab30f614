#include <fmt/format.h>
#include <fmt/ostream.h>

#include <cstdio>
#include <iostream>
#include <optional>
#include <sstream>

#include "app/command.hpp"
#include "app/keep_memory.hpp"
#include "app/session.hpp"
#include "core/error.hpp"
#include "core/version.hpp"

namespace pliant {
namespace {
std::string version_text() {
  const auto build = build_info();
  return fmt::format("pliant {} (commit {})\ncompiler: {} ({})\nMPI: {}", build.version, build.commit, build.compiler,
                     build.flags, mpi_library());
}

/// Parses the command line into an action. Returns the exit code when there is nothing to do: help, version, mistakes.
std::optional<int> parse(int argc, char** argv, const Communicator& ranks, Action& action) {
  CLI::App app("Pliant: flow and thin deforming bodies on a Cartesian grid", "pliant");
  app.require_subcommand(0, 1);  // its absence is told below, after a misspelt one
  app.set_version_flag("--version", version_text);
  app.footer("Exit codes: 0 success, 2 wrong input, 3 failed run. docs/case-reference.md lists the keys of a case.");
  add_run_command(app, action);
  add_check_command(app, action);
  add_mesh_command(app, action);
  add_calibrate_command(app, action);
  add_bench_command(app, action);
  add_reference_command(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, err;
    const int code = app.exit(error, out, err);
    if (ranks.is_root()) std::cout << out.str() << std::flush, std::cerr << err.str() << std::flush;
    return code == 0 ? exit_success : exit_input_error;
  }
  if (action) return std::nullopt;
  if (ranks.is_root()) fmt::print(stderr, "error: a subcommand is missing\n{}", app.help());
  return exit_input_error;
}

void print_problems(const InputError& error) {
  for (const auto& problem : error.problems()) fmt::print(stderr, "error: {}\n", problem);
  const auto count = error.problems().size();
  if (count > 1) fmt::print(stderr, "{} problems found\n", count);
}

int run_program(int argc, char** argv, const Communicator& ranks) {
  try {
    Action action;
    if (const auto code = parse(argc, argv, ranks, action)) return *code;
    return action(ranks);
  } catch (const InputError& error) {
    // Every rank reads the same input and finds the same problems.
    if (ranks.is_root()) print_problems(error);
    return exit_input_error;
  } catch (const CollectiveError& error) {
    if (ranks.is_root()) fmt::print(stderr, "error: {}\n", error.what());
    return exit_run_error;
  } catch (const std::exception& error) {
    if (ranks.size() == 1) fmt::print(stderr, "error: {}\n", error.what());
    else fmt::print(stderr, "error on rank {}: {}\n", ranks.rank(), error.what());
    return exit_run_error;
  }
}
}  // namespace
}  // namespace pliant

int main(int argc, char** argv) {
  pliant::keep_freed_memory();
  pliant::Session session(argc, argv);
  const int code = pliant::run_program(argc, argv, pliant::Communicator());
  std::fflush(stdout);
  // A full disk or a closed pipe behind standard output shows up here at the latest.
  const bool lost_output = std::ferror(stdout) != 0;
  return session.end_together(code == 0 && lost_output ? pliant::exit_run_error : code);
}
