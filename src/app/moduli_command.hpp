#pragma once
#include "app/command.hpp"

namespace pliant {

/// Adds `moduli` to `pliant mesh`.
void add_moduli_command(CLI::App& mesh, Action& action);

}  // namespace pliant
