#pragma once
#include <array>
#include <csignal>

namespace pliant {

/// Turns SIGINT, SIGTERM and SIGUSR1 into a request to stop, as long as it lives; one at a time in a program. A second
/// SIGINT ends the program at once. (mpirun passes SIGUSR1 on to all ranks and leaves them the time they need.)
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// The signal that this rank has received, or 0.
  int received() const;

 private:
  static constexpr std::array<int, 3> handled{SIGINT, SIGTERM, SIGUSR1};
  std::array<struct sigaction, 3> before_{};
};

}  // namespace pliant
