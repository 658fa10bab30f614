#pragma once
#include <span>
#include <string>
#include <vector>

#include "config/case_config.hpp"
#include "structure/place_bodies.hpp"

namespace pliant {

/// How a cavity's flow was made to fit an ejection fraction.
struct Ejection {
  std::string cavity, signal;
  double start_volume = 0, smallest_volume = 0, largest_volume = 0;
  double scale = 1;  ///< of the signal
};

/// The volume of a cavity at the start.
double start_volume(const CavityConfig& cavity, const CaseConfig& config, std::span<const PlacedBody> placed);

/// Sets the scales of the signals that cavities with an ejection_fraction name. With the volume V0 at the start, the
/// volume C(t) that has come in since the beginning of a cycle, and its extremes over the cycle, a scale s makes the
/// ejection fraction s (C_max - C_min) / (V0 + s C_max): the volume at the start is the smallest where the cycle begins
/// with filling, the largest where with emptying. `placed` are the bodies of the case. Throws InputError: a signal
/// without a period, one that moves nothing, or one that leaves the cavity larger or smaller after a cycle.
std::vector<Ejection> set_ejection_scales(CaseConfig& config, std::span<const PlacedBody> placed);

}  // namespace pliant
