#include "sweeps/stop_signals.hpp"

#include <atomic>

namespace shakebed::sweeps {
namespace {

std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may write only such");

void raise_flag(int) { stop.store(true); }

}  // namespace

StopSignals::StopSignals() {
  stop.store(false);
  struct sigaction action {};
  action.sa_handler = raise_flag;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  ::sigemptyset(&action.sa_mask);
  ::sigaction(SIGINT, &action, &old_interrupt_);
  ::sigaction(SIGTERM, &action, &old_terminate_);
}

StopSignals::~StopSignals() {
  ::sigaction(SIGINT, &old_interrupt_, nullptr);
  ::sigaction(SIGTERM, &old_terminate_, nullptr);
}

bool StopSignals::raised() { return stop.load(); }

}  // namespace shakebed::sweeps
