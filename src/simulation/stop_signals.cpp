#include "simulation/stop_signals.hpp"

namespace pliant {
namespace {

// A signal handler can reach nothing but a global of this type.
volatile std::sig_atomic_t received_signal = 0;

extern "C" void note_signal(int signal) {
  if (signal == SIGINT && received_signal == SIGINT) {
    std::signal(SIGINT, SIG_DFL);
    std::raise(SIGINT);
    return;
  }
  received_signal = signal;
}

}  // namespace

StopSignals::StopSignals() {
  received_signal = 0;
  struct sigaction action {};
  action.sa_handler = note_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;  // a write that is under way goes on
  for (std::size_t i = 0; i < handled.size(); ++i) sigaction(handled[i], &action, &before_[i]);
}

StopSignals::~StopSignals() {
  for (std::size_t i = 0; i < handled.size(); ++i) sigaction(handled[i], &before_[i], nullptr);
}

int StopSignals::received() const { return received_signal; }

}  // namespace pliant
