#pragma once

#include <cstddef>
#include <vector>

#include "simulator/crew.hpp"

namespace shakebed::simulator {

/// One stretch of blocks for each thread, as equal in work as was told last: neighbouring blocks
/// share rows, and a thread finds in its core's cache what it wrote before.
class WorkDivision {
 public:
  WorkDivision(Crew* crew, std::size_t blocks) : crew_(crew), begin_{0, blocks} {}

  Crew* crew() const { return crew_; }
  std::size_t threads() const { return begin_.size() - 1; }

  /// work(block, whether another thread does the block below) for all blocks.
  template <class Work>
  void share(const Work& work) const {
    Crew* helping = threads() > 1 ? crew_ : nullptr;
    simulator::share(helping, threads(), [&](std::size_t thread) {
      for (auto block = begin_[thread]; block < begin_[thread + 1]; ++block) {
        work(block, block == begin_[thread] && thread > 0);
      }
    });
  }

  template <class WorkIn>
  void divide(std::size_t blocks, WorkIn work_in) {
    if (crew_ == nullptr) return;
    std::size_t all = 0;
    for (std::size_t block = 0; block < blocks; ++block) all += work_in(block);
    const auto threads = static_cast<std::size_t>(crew_->threads());
    begin_.assign(threads + 1, blocks);
    begin_[0] = 0;
    std::size_t below = 0;
    std::size_t thread = 1;
    for (std::size_t block = 0; block < blocks; ++block) {
      const std::size_t middle = below + work_in(block) / 2;
      while (thread < threads && middle * threads >= all * thread) begin_[thread++] = block;
      below += work_in(block);
    }
  }

 private:
  Crew* crew_;
  std::vector<std::size_t> begin_;  ///< of each thread's stretch, and the end of the last
};

}  // namespace shakebed::simulator
