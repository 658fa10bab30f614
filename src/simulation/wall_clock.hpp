#pragma once
#include <chrono>
#include <optional>
#include <string>

namespace pliant {

/// The time that a run may take, as a batch system gives it: says when to stop so that the end is reached in time.
class WallClock {
 public:
  using Clock = std::chrono::steady_clock;
  /// `limit` in seconds from the start on; none: never time to stop.
  WallClock(std::optional<double> limit, Clock::time_point start) : limit_(limit), start_(start) {}

  /// Tells that a step of the run has ended, all its outputs included.
  void end_step();
  /// True if after one more step, as slow as the slowest so far, less than `reserve` seconds would be left, with a
  /// margin of a second and 2 % of the limit.
  bool is_time_to_stop(double reserve) const;

 private:
  std::optional<double> limit_;
  Clock::time_point start_, last_ = Clock::now();
  double slowest_step_ = 0;
};

/// Seconds of "HH:MM" or "HH:MM:SS". Throws InputError that names the option --wall-clock.
double parse_wall_clock(const std::string& text);

}  // namespace pliant
