#pragma once

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "simulator/crew.hpp"
#include "simulator/scene/scene.hpp"

namespace shakebed::sweeps {

/// Threads for one bed. A bed asks for help several times a step, each time for a few microseconds,
/// so that waiting threads watch a counter for a while before they sleep: to wake a sleeping one,
/// or to hand out tasks by a scheduler as oneTBB does, takes as long as the work.
class ThreadTeam final : public simulator::Crew {
 public:
  /// With the calling thread, `threads` in all.
  explicit ThreadTeam(int threads);
  ~ThreadTeam() override;
  /// As many threads as can share the work on a bed of this scene, `most` of them (0: one a core).
  static ThreadTeam for_bed(const simulator::Scene& scene, int most);
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  int threads() const override { return static_cast<int>(helpers_.size()) + 1; }

 protected:
  void share_out(std::size_t parts, Call call, const void* work) override;

 private:
  void help(std::size_t number);
  void do_parts_of(std::size_t number);

  struct Task {
    std::size_t parts = 0;
    Call call = nullptr;
    const void* work = nullptr;
  };

  Task task_;
  alignas(64) std::atomic<unsigned> round_ = 0;
  alignas(64) std::atomic<unsigned> done_ = 0;
  std::atomic<bool> dismissed_ = false;
  std::mutex error_guard_;
  std::exception_ptr error_;
  std::vector<std::thread> helpers_;
};

}  // namespace shakebed::sweeps
