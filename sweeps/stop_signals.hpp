#pragma once

#include <signal.h>

namespace shakebed::sweeps {

/// While one of these lives, the first SIGINT or SIGTERM raises a flag that beds poll; a second one
/// ends the process at once, which loses no finished run either.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  static bool raised();

 private:
  struct sigaction old_interrupt_ {};
  struct sigaction old_terminate_ {};
};

}  // namespace shakebed::sweeps
