#include <fmt/format.h>

#include "app/command.hpp"
#include "config/reference.hpp"
#include "core/error.hpp"

namespace pliant {

void add_reference_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("reference", "Print every key of the case file, as docs/case-reference.md");
  command->callback([&action] {
    action = [](const Communicator& ranks) -> int {
      if (ranks.is_root()) fmt::print("{}", case_reference());
      return exit_success;
    };
  });
}

}  // namespace pliant
