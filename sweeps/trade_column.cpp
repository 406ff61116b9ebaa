#include "sweeps/trade_column.hpp"

#include <array>
#include <cmath>
#include <numeric>

#include "simulator/record_lookup.hpp"
#include "sweeps/bias.hpp"
#include "sweeps/cached_runs.hpp"
#include "sweeps/trade_parts.hpp"

namespace shakebed::sweeps {
namespace {

using files::number_text;
using simulator::Estimate;
using simulator::Record;
using simulator::Scene;

constexpr double reference_steps = 50;  // t_c/dt
constexpr double usual_steps = 25;

void set_steps(Scene& scene, double steps_in_contact) {
  scene.column->time_step.reset();
  scene.protocol.time_step_fraction = 1 / steps_in_contact;
  scene.protocol.allow_coarse_time_step = true;
}

/// t_c goes as k_n^(-1/2): rates that grow as k_n^(1/2) leave each contact as it is but for its
/// duration.
void stiffen(Scene& scene, double factor) {
  for (auto* kind : {&scene.column->grain, &scene.column->wall}) {
    kind->normal_stiffness *= factor;
    kind->tangential_stiffness *= factor;
    kind->normal_rate *= std::sqrt(factor);
    kind->tangential_rate *= std::sqrt(factor);
  }
}

const std::vector<double>* series_of(const Record& record, const std::string& name) {
  for (const auto& series : record.series) {
    if (series.name == name) return &series.values;
  }
  return nullptr;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double mean_of_series(const Record& record, const std::string& name) {
  const auto* values = series_of(record, name);
  return values == nullptr ? std::nan("") : mean(*values);
}

/// Mean over independent runs, and its standard error from their scatter.
Estimate over_runs(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  if (values.empty()) return {};
  const double average = mean(values);
  double squares = 0;
  for (const double value : values) squares += (value - average) * (value - average);
  return {average, n > 1 ? std::sqrt(squares / (n - 1) / n) : std::nan("")};
}

struct Observed {
  const char* name;
  const char* unit;
  double (*of)(const Record&);
};
constexpr std::array observed{
    Observed{"rise_rate", "d/cycle", rise_rate},
    Observed{"coordination", "1",
             [](const Record& record) { return mean_of_series(record, "coordination"); }},
    Observed{"h_cm", "d",
             [](const Record& record) { return mean_of_series(record, "small_height"); }}};
using Estimates = std::array<Estimate, observed.size()>;

std::vector<files::CsvColumn> table_columns() {
  std::vector<files::CsvColumn> columns{
      {"scene", ""}, {"axis", ""}, {"value", "1"}, {"grains", "1"}, {"replicates", "1"}};
  for (const auto& one : observed) {
    columns.push_back({one.name, one.unit});
    columns.push_back({std::string(one.name) + "_se", one.unit});
  }
  for (const auto& one : observed) {
    columns.push_back({std::string(one.name) + "_bias", "%"});
    columns.push_back({std::string(one.name) + "_bias_se", "%"});
  }
  columns.insert(columns.end(), {{"k_n", "m g/d"},
                                 {"largest_overlap", "d"},
                                 {"cycles", "1"},
                                 {"seconds_per_1000_cycles", "s"},
                                 {"seconds_for_1_percent", "s"}});
  return columns;
}

Estimates estimates_of(const std::vector<Record>& records) {
  Estimates estimates;
  for (std::size_t q = 0; q < observed.size(); ++q) {
    std::vector<double> values;
    for (const auto& record : records) values.push_back(observed[q].of(record));
    estimates[q] = over_runs(values);
  }
  return estimates;
}

double largest(const std::vector<Record>& records, const std::string& scalar) {
  double most = std::nan("");
  for (const auto& record : records) most = std::fmax(most, scalar_of(record, scalar));
  return most;
}

}  // namespace

double rise_rate(const Record& record) {
  const auto* large = series_of(record, "large_height");
  const auto* small = series_of(record, "small_height");
  if (large == nullptr || small == nullptr) return std::nan("");
  const auto phases =
      static_cast<std::size_t>(std::lround(1 / record.series.front().cycles_per_entry));
  const std::size_t cycles = small->size() / phases;
  if (cycles < 2) return std::nan("");
  const double middle = 0.5 * static_cast<double>(cycles - 1);
  double slope = 0;
  double spread = 0;
  for (std::size_t cycle = 0; cycle < cycles; ++cycle) {
    double height = 0;
    for (std::size_t k = cycle * phases; k < (cycle + 1) * phases; ++k) {
      height += ((*large)[k] - (*small)[k]) / static_cast<double>(phases);
    }
    const double from_middle = static_cast<double>(cycle) - middle;
    slope += from_middle * height;
    spread += from_middle * from_middle;
  }
  return slope / spread;
}

void add_column_settings(Grid& grid, const Scene& base, bool all) {
  using Values = std::vector<double>;
  Scene usual = base;
  set_steps(usual, usual_steps);
  TradePoints points(grid, usual);
  points.add("reference", reference_steps, [](Scene& scene) { set_steps(scene, reference_steps); });
  for (const double n : all ? Values{7, 10, 14, usual_steps} : Values{10, usual_steps}) {
    points.add("dt", n, [n](Scene& scene) { set_steps(scene, n); });
  }
  for (const double n : all ? Values{10, usual_steps} : Values{10}) {
    points.add("half step", n, [n](Scene& scene) {
      set_steps(scene, n);
      scene.column->predict_velocities = false;
    });
  }
  for (const double factor : all ? Values{0.1, 0.3, 1, 3} : Values{0.1, 1}) {
    points.add("k_n", factor, [factor](Scene& scene) { stiffen(scene, factor); });
  }
  for (const double skin : all ? Values{0.2, 0.5, 1} : Values{1}) {
    points.add("list skin", skin, [skin](Scene& scene) { scene.column->list_skin = skin; });
  }
}

files::CsvTable column_trade_table(const std::string& scene, const Grid& grid,
                                   const store::Cache& cache, const std::vector<double>& seconds) {
  CachedRuns runs(grid, cache);
  Collected collected;
  std::vector<std::vector<Record>> records;
  std::vector<Estimates> estimates;
  for (std::size_t k = 0; k < runs.points(); ++k) {
    records.push_back(runs.records(k, collected));
    estimates.push_back(estimates_of(records.back()));
  }
  files::CsvTable table(table_columns());
  for (std::size_t k = 0; k < grid.points.size(); ++k) {
    const Point& point = grid.points[k];
    std::vector<std::string> row{scene, point.labels[0], point.labels[1],
                                 std::to_string(point.scene.grains.count),
                                 std::to_string(records[k].size())};
    for (const auto& estimate : estimates[k]) {
      row.push_back(number_text(estimate.mean));
      row.push_back(number_text(estimate.standard_error));
    }
    const std::size_t reference = compared_with(grid, point.labels[0]);
    for (std::size_t q = 0; q < observed.size(); ++q) {
      const Estimate bias = bias_percent(estimates[k][q], estimates[reference][q]);
      row.push_back(number_text(bias.mean));
      row.push_back(number_text(k == reference ? std::nan("") : bias.standard_error));
    }
    const double cycles = static_cast<double>(point.scene.protocol.cycles.value_or(1)) *
                          static_cast<double>(records[k].size());
    const Estimate rate = estimates[k].front();
    const double for_1_percent = cycles * std::pow(100 * rate.standard_error / rate.mean, 2);
    row.push_back(number_text(point.scene.column->grain.normal_stiffness));
    row.push_back(number_text(largest(records[k], "largest_overlap")));
    row.push_back(number_text(cycles));
    row.push_back(number_text(seconds[k]));
    row.push_back(number_text(1e-3 * for_1_percent * seconds[k]));
    table.add_row(std::move(row));
  }
  return table;
}

}  // namespace shakebed::sweeps
