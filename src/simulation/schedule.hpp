#pragma once
#include "config/case_config.hpp"

namespace pliant {

/// When an output series is due: at the start, then at multiples of an interval of time or of a number of steps.
class Schedule {
 public:
  explicit Schedule(const SeriesConfig& series) : series_(series) {}

  bool is_wanted() const { return series_.interval || series_.every; }
  /// The first multiple of the interval after `time`; infinity for a series that goes by steps or is not wanted.
  double next_time(double time) const;
  /// True at step 0, at every n-th step, and when `time` is a multiple of the interval (to 1e-9 of it).
  bool is_due(long step, double time) const;

 private:
  SeriesConfig series_;
};

}  // namespace pliant
