#pragma once
#include <chrono>
#include <optional>
#include <string>

namespace pliant {

/// The time that a run may take, as a batch system gives it: says when to stop so that the end is reached in time.
class WallClock {
 public:
  /// `limit` in seconds from now on; none: never time to stop.
  explicit WallClock(std::optional<double> limit) : limit_(limit) {}

  /// Tells that a step of the run has ended, all its outputs included.
  void end_step();
  /// True if after one more step, as slow as the slowest so far, less than `reserve` seconds would be left, with a
  /// margin of a second and 2 % of the limit.
  bool is_time_to_stop(double reserve) const;

 private:
  using Clock = std::chrono::steady_clock;
  std::optional<double> limit_;
  Clock::time_point start_ = Clock::now(), last_ = start_;
  double slowest_step_ = 0;
};

/// Seconds of "HH:MM" or "HH:MM:SS". Throws InputError that names the option --wall-clock.
double parse_wall_clock(const std::string& text);

}  // namespace pliant
