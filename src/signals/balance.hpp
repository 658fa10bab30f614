#pragma once
#include "signals/signal.hpp"

namespace pliant {

/// What the positive values of a signal carry in a period, and the negative ones, both as positive numbers.
struct PeriodParts {
  double positive = 0, negative = 0;
};

/// By adaptive quadrature, to about 1e-12 of the sum of both. The signal must have a period.
PeriodParts parts_of_period(const Signal& signal);

/// The largest and the least value of many over [0, end], and where they are.
struct SignalRange {
  double largest = 0, largest_at = 0, least = 0, least_at = 0;
};
SignalRange range_of(const Signal& signal, double end);

}  // namespace pliant
