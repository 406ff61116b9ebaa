#include "sweeps/progress.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace shakebed::sweeps {
namespace {

constexpr double terminal_interval = 0.2;       // s
constexpr double plain_interval = 10;           // s
constexpr double plain_interval_of_tenths = 1;  // s
constexpr const char* clear_line = "\r\033[K";

}  // namespace

std::string clock_text(double seconds) {
  const long whole = std::lround(std::max(0.0, seconds));
  char text[32];
  if (whole < 3600) {
    std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
  }
  return text;
}

Progress::Progress(std::ostream& out, bool on_terminal, std::string title, Clock clock)
    : out_(out), on_terminal_(on_terminal), title_(std::move(title)), clock_(std::move(clock)) {}

Progress::Clock Progress::steady_clock() {
  return [] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  };
}

void Progress::begin(std::size_t runs, double predicted_cost) {
  const std::scoped_lock lock(mutex_);
  runs_ = runs;
  predicted_ = predicted_cost;
  started_ = shown_ = clock_();
}

void Progress::advance(double cost) {
  const std::scoped_lock lock(mutex_);
  done_ += cost;
  show(false);
}

void Progress::finish_run() {
  const std::scoped_lock lock(mutex_);
  ++finished_;
  show(false);
}

void Progress::end() {
  const std::scoped_lock lock(mutex_);
  show(true);
  if (line_is_open_) out_ << '\n' << std::flush;
  line_is_open_ = false;
}

std::string Progress::line(double now) const {
  const double share = predicted_ > 0 ? std::clamp(done_ / predicted_, 0.0, 1.0) : 0;
  const double elapsed = now - started_;
  std::string text = title_ + ": " + std::to_string(finished_) + " of " + std::to_string(runs_) +
                     " beds, " + std::to_string(std::lround(100 * share)) + " %, " +
                     clock_text(elapsed) + " gone";
  // The first per cent says little about the speed of the machine.
  if (share > 0.01 && finished_ < runs_) {
    text += ", about " + clock_text(elapsed * (1 - share) / share) + " to go";
  }
  return text;
}

void Progress::show(bool at_the_end) {
  const double now = clock_();
  if (on_terminal_) {
    if (!at_the_end && now - shown_ < terminal_interval) return;
    out_ << clear_line << line(now) << std::flush;
    line_is_open_ = true;
  } else {
    const int tenths = predicted_ > 0 ? static_cast<int>(10 * done_ / predicted_) : 0;
    const double since = now - shown_;
    const bool due =
        since >= plain_interval || (tenths > shown_tenths_ && since >= plain_interval_of_tenths);
    if (!at_the_end && !due) return;
    out_ << line(now) << '\n' << std::flush;
    shown_tenths_ = tenths;
  }
  shown_ = now;
}

}  // namespace shakebed::sweeps
