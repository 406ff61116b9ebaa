#pragma once

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

}  // namespace shakebed::sweeps
