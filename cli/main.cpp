#include <cstdio>
#include <exception>

#include "cli/arguments.hpp"
#include "files/error.hpp"

int main(int argc, char** argv) {
  using shakebed::files::Error;
  try {
    return shakebed::cli::dispatch(argc, argv);
  } catch (const shakebed::files::Interrupted& interrupted) {
    std::fprintf(stderr, "shakebed: %s\n", interrupted.what());
    return 130;
  } catch (const Error& error) {
    for (const auto& fault : error.faults()) {
      std::fprintf(stderr, "shakebed: error: %s%s%s\n", fault.where.c_str(),
                   fault.where.empty() ? "" : ": ", fault.what.c_str());
    }
    return error.kind() == Error::Kind::bad_input ? 2 : 1;
  } catch (const std::exception& unexpected) {
    std::fprintf(stderr, "shakebed: internal error: %s\n", unexpected.what());
    return 1;
  }
}
