#pragma once

#include <cstddef>

namespace shakebed::tests {

/// What the program's operator new has handed out, over all of its life.
struct Allocations {
  long calls;
  std::size_t live_bytes;  ///< now
  std::size_t peak_bytes;  ///< the most since reset_peak()
};

Allocations allocations();
void reset_peak();

}  // namespace shakebed::tests
