#pragma once
#include <filesystem>
#include <vector>

#include "structure/placement.hpp"

namespace pliant {

/// Reads the places of copies from a CSV file: x, y, z on each line, and optionally ax, ay, az, angle, a rotation by
/// `angle` degrees about that axis. A first line with names is optional; it may give the columns in another order.
/// Empty lines and lines that begin with # are skipped. Throws InputError with every problem and its line.
std::vector<Placement> read_positions(const std::filesystem::path& path);

}  // namespace pliant
