#include "tests/memory/counted_allocations.hpp"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace shakebed::tests {
namespace {

std::atomic<long> calls{0};
std::atomic<std::size_t> live{0};
std::atomic<std::size_t> peak{0};

void* counted(void* memory) {
  if (!memory) throw std::bad_alloc();
  ++calls;
  const std::size_t now = live += malloc_usable_size(memory);
  std::size_t highest = peak;
  while (now > highest && !peak.compare_exchange_weak(highest, now)) {
  }
  return memory;
}

void release(void* memory) noexcept {
  if (memory) live -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

Allocations allocations() { return {calls, live, peak}; }
void reset_peak() { peak = live.load(); }

}  // namespace shakebed::tests

// The other forms of new and delete call these by default.
void* operator new(std::size_t size) {
  return shakebed::tests::counted(std::malloc(std::max<std::size_t>(size, 1)));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto a = static_cast<std::size_t>(alignment);
  return shakebed::tests::counted(std::aligned_alloc(a, (size + a - 1) / a * a));
}
void operator delete(void* memory) noexcept { shakebed::tests::release(memory); }
void operator delete(void* memory, std::size_t) noexcept { shakebed::tests::release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { shakebed::tests::release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  shakebed::tests::release(memory);
}
