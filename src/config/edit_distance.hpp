#pragma once
#include <span>
#include <string>
#include <string_view>

namespace pliant {

/// Edits (insert, delete, replace, swap of neighbours) that turn `a` into `b`: the optimal string alignment distance.
int edit_distance(std::string_view a, std::string_view b);

/// The candidate closest to `name`, the first of equals; empty when there are none. A match of the last part of a
/// dotted key counts as well, so that a key set in the wrong section finds its home.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

}  // namespace pliant
