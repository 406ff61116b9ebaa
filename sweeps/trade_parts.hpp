#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "files/csv.hpp"
#include "sweeps/grid.hpp"

namespace shakebed::sweeps {

/// Adds points to a trade study's grid, each with one setting of `base` changed.
class TradePoints {
 public:
  TradePoints(Grid& grid, const simulator::Scene& base) : grid_(grid), base_(base) {}

  template <class Change>
  void add(const std::string& axis, double value, Change change) {
    Point point;
    point.labels = {axis, files::number_text(value)};
    point.scene = base_;
    change(point.scene);
    grid_.points.push_back(std::move(point));
  }

 private:
  Grid& grid_;
  const simulator::Scene& base_;
};

/// The row that an axis is compared with: the hardest grains for k_n, else the first.
inline std::size_t compared_with(const Grid& grid, const std::string& axis) {
  if (axis != "k_n") return 0;
  std::size_t last = 0;  // k_n ascends
  for (std::size_t k = 0; k < grid.points.size(); ++k) {
    if (grid.points[k].labels[0] == "k_n") last = k;
  }
  return last;
}

/// 100 (x/x_0 - 1) and its standard error, the two being independent.
inline simulator::Estimate bias_percent(const simulator::Estimate& x,
                                        const simulator::Estimate& reference) {
  const double ratio = x.mean / reference.mean;
  const double error = std::abs(ratio) * std::hypot(x.standard_error / x.mean,
                                                    reference.standard_error / reference.mean);
  return {100 * (ratio - 1), 100 * error};
}

}  // namespace shakebed::sweeps
