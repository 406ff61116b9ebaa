#include "simulator/observables/column_series.hpp"

#include <array>
#include <cmath>
#include <numeric>

#include "simulator/observables/correlation.hpp"

namespace shakebed::simulator {
namespace {

using Column = ColumnSeries::Column;

/// Means over whole cycles.
std::vector<double> cycle_means(const std::vector<double>& values, long phases) {
  std::vector<double> means;
  const auto n = static_cast<std::size_t>(phases);
  for (std::size_t k = 0; k + n <= values.size(); k += n) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(k);
    means.push_back(std::accumulate(first, first + phases, 0.0) / static_cast<double>(phases));
  }
  return means;
}

/// How far the large grain's top stands over (> 0) or under the bed's surface, cycle by cycle.
std::vector<double> above_surface(const ColumnSeries& series, long phases, double large_radius) {
  const auto& large = series[Column::large_height];
  const auto& small = series[Column::small_height];
  if (small.empty()) return {};
  const double half_height = small.front() - series[Column::base_height].front();
  std::vector<double> above;
  for (std::size_t k = 0; k < large.size(); ++k) {
    above.push_back(large[k] + large_radius - small[k] - half_height);
  }
  return cycle_means(above, phases);
}

}  // namespace

double rise_time(const ColumnSeries& series, long phases, double large_radius) {
  const auto above = above_surface(series, phases, large_radius);
  std::size_t there = above.size();  // from here on it stays
  while (there > 0 && above[there - 1] >= -large_radius) --there;
  while (there < above.size() && above[there] < 0) ++there;
  if (there == above.size()) return std::nan("");
  if (there == 0) return 0;
  const double share = -above[there - 1] / (above[there] - above[there - 1]);
  return static_cast<double>(there) - 0.5 + share;
}

void write_column_series(Record& record, const ColumnSeries& series, long phases,
                         double large_radius, bool has_large) {
  for (std::size_t c = 0; c < ColumnSeries::columns; ++c) {
    const auto column = static_cast<Column>(c);
    const bool of_large = column == Column::large_height || column == Column::large_velocity;
    if (of_large && !has_large) continue;
    record.series.push_back({ColumnSeries::name(column), ColumnSeries::unit(column),
                             1 / static_cast<double>(phases), series[column]});
    record.quantities.push_back({ColumnSeries::name(column), ColumnSeries::unit(column),
                                 mean_of_series(cycle_means(series[column], phases)).estimate});
  }
  if (!has_large) return;
  const double rise = rise_time(series, phases, large_radius);
  record.quantities.push_back({"rise_time", "cycles", {rise, std::nan("")}});
  record.scalars.push_back({"risen", "1", std::isnan(rise) ? 0.0 : 1.0});
  const auto above = above_surface(series, phases, large_radius);
  if (!above.empty()) {
    record.scalars.push_back({"large_above_surface", "d", above.back()});
    record.scalars.push_back({"large_above_surface_at_first", "d", above.front()});
  }
}

}  // namespace shakebed::simulator
