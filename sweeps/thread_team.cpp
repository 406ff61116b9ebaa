#include "sweeps/thread_team.hpp"

#include <tbb/info.h>

#include <algorithm>
#include <utility>

#include "simulator/simulate.hpp"

namespace shakebed::sweeps {
namespace {

// Some ten microseconds: longer than a thread waits between two tasks of a step.
constexpr int looks_before_sleep = 4000;

void rest_a_moment() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#else
  std::this_thread::yield();
#endif
}

/// Waits until `counter` is no longer `old`.
void wait_for_change(const std::atomic<unsigned>& counter, unsigned old) {
  for (int look = 0; look < looks_before_sleep; ++look) {
    if (counter.load(std::memory_order_acquire) != old) return;
    rest_a_moment();
  }
  counter.wait(old, std::memory_order_acquire);
}

}  // namespace

ThreadTeam::ThreadTeam(int threads) {
  for (int number = 1; number < threads; ++number) {
    helpers_.emplace_back([this, number] { help(static_cast<std::size_t>(number)); });
  }
}

ThreadTeam ThreadTeam::for_bed(const simulator::Scene& scene, int most) {
  const int cores = most > 0 ? most : tbb::info::default_concurrency();
  return ThreadTeam(std::min(cores, simulator::useful_threads(scene)));
}

ThreadTeam::~ThreadTeam() {
  dismissed_ = true;
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  for (auto& helper : helpers_) helper.join();
}

void ThreadTeam::share_out(std::size_t parts, Call call, const void* work) {
  const auto helpers = static_cast<unsigned>(helpers_.size());
  task_ = {parts, call, work};
  done_.store(0, std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  do_parts_of(0);
  for (unsigned done = done_.load(std::memory_order_acquire); done != helpers;
       done = done_.load(std::memory_order_acquire)) {
    wait_for_change(done_, done);
  }
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

void ThreadTeam::help(std::size_t number) {
  for (unsigned seen = 0;; ++seen) {
    wait_for_change(round_, seen);
    if (dismissed_) return;
    do_parts_of(number);
    done_.fetch_add(1, std::memory_order_release);
    done_.notify_all();
  }
}

void ThreadTeam::do_parts_of(std::size_t number) {
  // Neighbouring parts share rows: one stretch of them a thread keeps most in one core's cache.
  const std::size_t threads = helpers_.size() + 1;
  const std::size_t end = task_.parts * (number + 1) / threads;
  try {
    for (std::size_t part = task_.parts * number / threads; part < end; ++part) {
      task_.call(task_.work, part);
    }
  } catch (...) {
    const std::scoped_lock lock(error_guard_);
    if (!error_) error_ = std::current_exception();
  }
}

}  // namespace shakebed::sweeps
