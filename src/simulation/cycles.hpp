#pragma once
#include <cmath>

namespace pliant {

/// The number of the cycle that time t is in, from 0, and how far into it in [0, 1). Moments that rounding has put just
/// before a cycle's beginning belong to it.
struct CycleTime {
  long cycle = 0;
  double phase = 0;
};
inline CycleTime cycle_time(double t, double period) {
  constexpr double tolerance = 1e-9;
  const double cycles = t / period, whole = std::floor(cycles + tolerance);
  return {static_cast<long>(whole), std::fmax(0.0, cycles - whole)};
}

}  // namespace pliant
