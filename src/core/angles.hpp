#pragma once
#include <numbers>

namespace pliant {

/// In radians: cases and reports have angles in degrees, all else in radians.
inline constexpr double degree = std::numbers::pi / 180;

}  // namespace pliant
