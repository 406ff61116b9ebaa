#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <ostream>
#include <string>

namespace shakebed::sweeps {

/// Says how far an ensemble is and how long it will take, weighted by the predicted cost of its
/// beds. On a terminal one line is kept up to date; elsewhere a line is printed every ten seconds,
/// or every ten per cent when that takes at least a second. All members may be called by any
/// thread.
class Progress {
 public:
  using Clock = std::function<double()>;  ///< seconds

  Progress(std::ostream& out, bool on_terminal, std::string title, Clock clock = steady_clock());
  static Clock steady_clock();

  void begin(std::size_t runs, double predicted_cost);
  void advance(double cost);  ///< of what was predicted
  void finish_run();
  void end();  ///< leaves the cursor on a fresh line

 private:
  std::string line(double now) const;
  void show(bool at_the_end);

  std::ostream& out_;
  bool on_terminal_;
  std::string title_;
  Clock clock_;
  std::mutex mutex_;
  std::size_t runs_ = 0;
  std::size_t finished_ = 0;
  double predicted_ = 0;
  double done_ = 0;
  double started_ = 0;
  double shown_ = 0;
  int shown_tenths_ = 0;
  bool line_is_open_ = false;
};

/// "0:07", "12:34", "1:02:03".
std::string clock_text(double seconds);

}  // namespace shakebed::sweeps
