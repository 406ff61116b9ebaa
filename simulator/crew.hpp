#pragma once

#include <cstddef>

namespace shakebed::simulator {

/// Threads that share the work on one bed. Beds are cut into parts by their size alone, and sums
/// over parts are taken in one order: what a bed computes does not depend on who does which part.
class Crew {
 public:
  virtual ~Crew() = default;

  virtual int threads() const = 0;

  /// Calls work(part) for every part below `parts`, in any order and on any thread, and returns
  /// when all are done.
  template <class Work>
  void share(std::size_t parts, const Work& work) {
    share_out(
        parts, [](const void* what, std::size_t part) { (*static_cast<const Work*>(what))(part); },
        &work);
  }

 protected:
  using Call = void (*)(const void*, std::size_t);
  virtual void share_out(std::size_t parts, Call call, const void* work) = 0;
};

/// The same without a crew: one part after the other.
template <class Work>
void share(Crew* crew, std::size_t parts, const Work& work) {
  if (crew != nullptr) {
    crew->share(parts, work);
  } else {
    for (std::size_t part = 0; part < parts; ++part) work(part);
  }
}

}  // namespace shakebed::simulator
