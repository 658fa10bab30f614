#include "simulation/schedule.hpp"

#include <cmath>
#include <limits>

namespace pliant {
namespace {
constexpr double tolerance = 1e-9;  // of an interval; far above the rounding of sums, far below any step
}

double Schedule::next_time(double time) const {
  if (!series_.interval) return std::numeric_limits<double>::infinity();
  // Products, not sums: the thousandth output is as exact as the first.
  return (std::floor(time / *series_.interval + tolerance) + 1) * *series_.interval;
}

bool Schedule::is_due(long step, double time) const {
  if (!is_wanted()) return false;
  if (step == 0) return true;
  if (series_.every && step % *series_.every == 0) return true;
  if (!series_.interval) return false;
  const double count = time / *series_.interval;
  return std::abs(count - std::round(count)) < tolerance;
}

}  // namespace pliant
