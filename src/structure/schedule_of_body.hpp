#pragma once
#include <cmath>

#include "config/case_config.hpp"

namespace pliant {

/// Whether a body with this schedule acts on the flow at that time.
inline bool is_on(const ScheduleConfig& schedule, double time) {
  const double periods = time / schedule.period, now = periods - std::floor(periods);
  const bool begun = now >= schedule.phase[0], ended = now >= schedule.phase[1];
  return schedule.phase[0] < schedule.phase[1] ? begun && !ended : begun || !ended;
}

}  // namespace pliant
