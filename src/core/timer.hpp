#pragma once
#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace pliant {

/// Wall-clock time summed by phase.
class PhaseTimer {
 public:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::map<std::string, double, std::less<>>;

  /// Adds the time of its own life to a phase.
  class Scope {
   public:
    Scope(PhaseTimer& timer, const char* phase) : timer_(timer), phase_(phase), start_(Clock::now()) {}
    ~Scope() { timer_.add(phase_, std::chrono::duration<double>(Clock::now() - start_).count()); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    PhaseTimer& timer_;
    const char* phase_;
    Clock::time_point start_;
  };

  Scope measure(const char* phase) { return Scope(*this, phase); }
  void add(std::string_view phase, double seconds) {
    const auto found = seconds_.find(phase);
    if (found != seconds_.end()) found->second += seconds;
    else seconds_.emplace(phase, seconds);
  }
  const Seconds& seconds() const { return seconds_; }
  double total() const {
    double sum = 0;
    for (const auto& [phase, s] : seconds_) sum += s;
    return sum;
  }
  void reset() { seconds_.clear(); }

 private:
  Seconds seconds_;
};

}  // namespace pliant
