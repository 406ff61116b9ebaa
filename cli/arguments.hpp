#pragma once

namespace shakebed::cli {

/// Reads the command line, calls the subcommand and returns its exit code. Usage faults: 2.
int dispatch(int argc, char** argv);

}  // namespace shakebed::cli
