#include "simulation/wall_clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "core/error.hpp"

namespace pliant {

void WallClock::end_step() {
  const auto now = Clock::now();
  slowest_step_ = std::max(slowest_step_, std::chrono::duration<double>(now - last_).count());
  last_ = now;
}

bool WallClock::is_time_to_stop(double reserve) const {
  if (!limit_) return false;
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  const double margin = 1 + 0.02 * *limit_;
  return elapsed + slowest_step_ + reserve + margin > *limit_;
}

double parse_wall_clock(const std::string& text) {
  std::smatch parts;
  if (!std::regex_match(text, parts, std::regex("([0-9]{1,5}):([0-5][0-9])(?::([0-5][0-9]))?")))
    throw InputError(
        fmt::format("--wall-clock {} is not a time; give hours and minutes, and seconds if you like: "
                    "02:50 or 02:50:00",
                    text));
  const double seconds = parts[3].matched ? std::stod(parts[3]) : 0;
  return 3600 * std::stod(parts[1]) + 60 * std::stod(parts[2]) + seconds;
}

}  // namespace pliant
