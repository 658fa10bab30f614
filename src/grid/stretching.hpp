#pragma once
#include <vector>

#include "config/case_config.hpp"

namespace pliant {

/// The n + 1 faces of n cells over [origin, origin + length], ascending.
/// tanh: z = origin + length/2 (1 + tanh(s (2k/n - 1)) / tanh(s)), dense at both ends.
/// cluster: cells of one size h over `width` about `center`, beyond it of size h + growth times the distance from that
/// range; h follows from n.
std::vector<double> stretched_faces(const StretchingConfig& stretching, int cells, double origin, double length);

}  // namespace pliant
