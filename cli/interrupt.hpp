#pragma once

namespace shakebed::cli {

/// From here on the first SIGINT or SIGTERM only asks to stop (a second one ends the process).
void stop_on_signals();
bool stop_asked();

}  // namespace shakebed::cli
