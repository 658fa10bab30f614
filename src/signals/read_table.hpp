#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace pliant {

/// Reads lines of two numbers `t, v`, separated by a comma, a semicolon or blanks. Empty lines, # comments and one line
/// of names before the first numbers are skipped. Throws InputError: the file cannot be read or has no numbers; every
/// line that is not two finite numbers or whose time does not grow.
std::vector<std::array<double, 2>> read_table(const std::filesystem::path& file);

}  // namespace pliant
