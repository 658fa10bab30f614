#include "simulation/schedule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pliant {
namespace {
constexpr double tolerance = 1e-9;  // of an interval; far above the rounding of sums, far below any step
}

double Schedule::next_time(double time) const {
  double next = std::numeric_limits<double>::infinity();
  // Products, not sums: the thousandth output is as exact as the first.
  if (series_.interval) next = (std::floor(time / *series_.interval + tolerance) + 1) * *series_.interval;
  for (const double phase : series_.phases)
    next = std::min(next, (std::floor(time / period_ - phase + tolerance) + 1 + phase) * period_);
  return next;
}

bool Schedule::is_due(long step, double time) const {
  const auto is_whole = [](double count) { return std::abs(count - std::round(count)) < tolerance; };
  if (step == 0 && (series_.interval || series_.every)) return true;
  if (series_.every && step % *series_.every == 0) return true;
  if (series_.interval && is_whole(time / *series_.interval)) return true;
  return std::any_of(series_.phases.begin(), series_.phases.end(),
                     [&](double phase) { return is_whole(time / period_ - phase); });
}

}  // namespace pliant
