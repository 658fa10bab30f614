#include "simulation/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace pliant {
namespace {

using Seconds = std::chrono::duration<double>;
constexpr Seconds bar_period{0.2};
constexpr Seconds line_period{2.0};

ProgressStyle resolve(ProgressStyle style) {
  if (style != ProgressStyle::automatic) return style;
  // Open MPI's mpirun gives the ranks a terminal of its own making, whatever it stands in front of itself.
  const bool is_launched = std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr;
  return isatty(STDOUT_FILENO) && !is_launched ? ProgressStyle::bar : ProgressStyle::lines;
}

std::size_t terminal_columns() {
  struct winsize size {};
  const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

std::string draw_bar(double fraction, int width) {
  const int full = static_cast<int>(std::lround(std::clamp(fraction, 0.0, 1.0) * width));
  return fmt::format("[{}{}]", std::string(static_cast<std::size_t>(full), '#'),
                     std::string(static_cast<std::size_t>(width - full), '.'));
}

}  // namespace

std::string format_duration(double seconds) {
  if (!std::isfinite(seconds) || seconds > 3.6e6) return "--:--";
  const long whole = std::lround(seconds);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

Progress::Progress(Log log, ProgressStyle style, ProgressGoal goal)
    : log_(std::move(log)), style_(resolve(style)), goal_(goal) {}

bool Progress::is_due() const {
  if (style_ == ProgressStyle::silent) return false;
  return Clock::now() - last_ >= (style_ == ProgressStyle::bar ? bar_period : line_period);
}

void Progress::show(const ProgressLine& line) {
  if (style_ == ProgressStyle::silent) return;
  const auto now = Clock::now();
  const auto text = describe(line, Seconds(now - last_).count());
  last_ = now;
  last_step_ = line.step;
  if (style_ == ProgressStyle::lines) {
    log_.info("{}", text);
    return;
  }
  // A line that wraps could not be drawn over: each would stay, and push the screen up.
  fmt::print("\r\x1b[K{}", text.substr(0, terminal_columns() - 1));
  std::fflush(stdout);
  is_drawn_ = true;
}

void Progress::finish() {
  if (!is_drawn_) return;
  fmt::print("\n");
  std::fflush(stdout);
  is_drawn_ = false;
}

void Progress::begin_at(long step, double time) {
  last_step_ = step;
  done_before_ = fraction_done(step, time);
}

double Progress::fraction_done(long step, double time) const {
  const double by_time = goal_.end_time > 0 ? time / goal_.end_time : 0;
  if (goal_.max_steps <= 0) return by_time;
  return std::max(by_time, static_cast<double>(step) / static_cast<double>(goal_.max_steps));
}

std::string Progress::describe(const ProgressLine& line, double wall) const {
  const double fraction = fraction_done(line.step, line.time), done = fraction - done_before_;
  const double elapsed = Seconds(Clock::now() - start_).count();
  const double left = done > 0 ? elapsed * (1 - fraction) / done : HUGE_VAL;
  const auto steps = static_cast<double>(line.step - last_step_);
  std::string speed;
  if (steps > 0 && wall > 0)
    speed = fmt::format("  {:.3g} steps/s  {:.3g} ns/cell", steps / wall, 1e9 * wall / (steps * goal_.cells));
  const auto remaining = format_duration(left);
  const auto text = fmt::format("step {}  t {:.4g}/{:.4g}  dt {:.2e}  cfl {:.3f}  div {:.1e}{}  left {}", line.step,
                                line.time, goal_.end_time, line.dt, line.cfl, line.divergence, speed, remaining);
  if (style_ != ProgressStyle::bar) return text;
  constexpr std::size_t wide = 20, brackets = 4;
  if (text.size() + wide + brackets <= terminal_columns()) return draw_bar(fraction, wide) + " " + text;
  // What a narrow terminal has room for.
  const auto rate = steps > 0 && wall > 0 ? fmt::format(" {:.3g} steps/s", steps / wall) : std::string();
  return fmt::format("{} {} t {:.4g}/{:.4g} cfl {:.2f} div {:.0e}{} left {}", draw_bar(fraction, 6), line.step,
                     line.time, goal_.end_time, line.cfl, line.divergence, rate, remaining);
}

}  // namespace pliant
