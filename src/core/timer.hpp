#pragma once
#include <chrono>
#include <map>
#include <string>

namespace pliant {

/// Wall-clock time summed by phase.
class PhaseTimer {
 public:
  using Clock = std::chrono::steady_clock;

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
  void add(const std::string& phase, double seconds) { seconds_[phase] += seconds; }
  const std::map<std::string, double>& seconds() const { return seconds_; }
  double total() const {
    double sum = 0;
    for (const auto& [phase, s] : seconds_) sum += s;
    return sum;
  }
  void reset() { seconds_.clear(); }

 private:
  std::map<std::string, double> seconds_;
};

}  // namespace pliant
