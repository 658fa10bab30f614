#pragma once
#include <optional>
#include <utility>

#include "config/case_config.hpp"

namespace pliant {

/// When an output series is due: at the start, then at multiples of an interval of time or of a number of steps; and at
/// given phases of a cycle that begins at time 0.
class Schedule {
 public:
  /// `period` of the cycle: needed for phases alone.
  explicit Schedule(SeriesConfig series, std::optional<double> period = std::nullopt)
      : series_(std::move(series)), period_(period.value_or(0)) {}

  bool is_wanted() const { return series_.interval || series_.every || !series_.phases.empty(); }
  /// The first multiple of the interval, or wanted phase, after `time`; infinity for a series that goes by steps or is
  /// not wanted.
  double next_time(double time) const;
  /// True at every n-th step, when `time` is a multiple of the interval (to 1e-9 of it), the start counting for both,
  /// and at wanted phases (to 1e-9 of the period).
  bool is_due(long step, double time) const;

 private:
  SeriesConfig series_;
  double period_;
};

}  // namespace pliant
