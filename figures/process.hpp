#pragma once

#include <string>
#include <vector>

namespace shakebed::figures {

struct ProcessResult {
  int exit_code = 0;
  std::string error_text;  ///< what it wrote to standard error
};

/// Runs a program without a shell, standard input and output closed off, and waits for it. Throws
/// std::system_error when the program cannot be started.
ProcessResult run_process(const std::vector<std::string>& command);

}  // namespace shakebed::figures
