#pragma once
#include <chrono>
#include <string>

#include "core/log.hpp"

namespace pliant {

/// What a line of progress shows.
struct ProgressLine {
  long step = 0;
  double time = 0;
  double dt = 0;
  double cfl = 0;
  double divergence = 0;
};

enum class ProgressStyle {
  automatic,  ///< a bar on a terminal, plain lines elsewhere
  lines,
  bar,
  silent
};

/// The goal that remaining time is counted to.
struct ProgressGoal {
  double end_time = 0;
  long max_steps = -1;  ///< negative: none
  double cells = 0;     ///< of the whole box, for the speed
};

/// Tells people how far a run is: one line that is redrawn on a terminal, a plain line every few seconds elsewhere.
/// For the root alone; the others have a silent one.
class Progress {
 public:
  Progress(Log log, ProgressStyle style, ProgressGoal goal);

  /// A run that continues begins here: speed and remaining time count from this step on.
  void begin_at(long step, double time);
  /// True if it is time to show something; what is costly to find out is found out only then.
  bool is_due() const;
  void show(const ProgressLine& line);
  /// Leaves the line of the bar, so that other output begins on a line of its own.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  double fraction_done(long step, double time) const;
  std::string describe(const ProgressLine& line, double wall) const;

  Log log_;
  ProgressStyle style_;
  ProgressGoal goal_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
  long last_step_ = 0;
  double done_before_ = 0;  // part of the run
  bool is_drawn_ = false;
};

/// Hours, minutes and seconds: "1:02:03", or "--:--" for what is not known.
std::string format_duration(double seconds);

}  // namespace pliant
