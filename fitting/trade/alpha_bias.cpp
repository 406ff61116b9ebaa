#include "fitting/trade/alpha_bias.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace shakebed::fitting::trade {
namespace {

using files::CsvTable;
using files::number_text;

constexpr double least_W = 5;

using Family = std::vector<std::string>;  // dimension, rough, layers, restitution, amplitude

Family family_of(const CsvTable& table, std::size_t row) {
  Family family;
  for (const char* name : {"dimension", "rough", "layers", "restitution", "amplitude"}) {
    family.push_back(table.text(row, table.column(name)));
  }
  return family;
}

double W_of(const CsvTable& table, std::size_t row) { return table.number(row, table.column("W")); }

/// The family with most values of W, and how many.
std::pair<Family, std::size_t> largest_family(const CsvTable& table) {
  std::map<Family, std::vector<double>> members;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, table.column("axis")) != "reference") continue;
    if (W_of(table, row) < least_W) continue;
    members[family_of(table, row)].push_back(W_of(table, row));
  }
  std::pair<Family, std::size_t> largest;
  for (const auto& [family, values] : members) {
    if (values.size() > largest.second) largest = {family, values.size()};
  }
  return largest;
}

struct Points {
  std::vector<double> x, y, error;
};

/// Unweighted, so that the settings' curves, which bend a little, are weighed alike.
AlphaBias fitted(const std::string& axis, const std::string& value, const Points& points) {
  const auto n = static_cast<double>(points.x.size());
  double middle = 0;
  for (const double x : points.x) middle += x / n;
  double spread = 0, slope = 0, variance = 0;
  for (std::size_t k = 0; k < points.x.size(); ++k) {
    const double x = points.x[k] - middle;
    spread += x * x;
    slope += x * points.y[k];
    variance += std::pow(x * points.error[k], 2);
  }
  return {axis, value, 2 * slope / spread, 2 * std::sqrt(variance) / spread, 0, std::nan("")};
}

void compare(std::vector<AlphaBias>& all) {
  const AlphaBias* hardest = nullptr;  // k_n ascends
  for (const auto& one : all) {
    if (one.axis == "k_n") hardest = &one;
  }
  const auto reference =
      std::ranges::find_if(all, [](const auto& one) { return one.axis == "reference"; });
  if (reference == all.end()) return;
  for (auto& one : all) {
    const AlphaBias& with = one.axis == "k_n" ? *hardest : *reference;
    one.bias = one.alpha - with.alpha;
    if (&one != &with) one.bias_error = std::hypot(one.error, with.error);
  }
}

}  // namespace

std::vector<AlphaBias> alpha_biases(const CsvTable& table) {
  const auto [family, scenes] = largest_family(table);
  if (scenes < 3) return {};
  std::vector<std::pair<std::string, std::string>> settings;  // in order of appearance
  std::map<std::pair<std::string, std::string>, Points> points;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double T_z = table.number(row, table.column("T_z"));
    const double error = table.number(row, table.column("T_z_se")) / T_z;
    if (!(T_z > 0) || !(error > 0) || W_of(table, row) < least_W) continue;
    if (family_of(table, row) != family) continue;
    const std::pair setting{table.text(row, table.column("axis")),
                            table.text(row, table.column("value"))};
    if (!points.contains(setting)) settings.push_back(setting);
    auto& of = points[setting];
    of.x.push_back(std::log(W_of(table, row)));
    of.y.push_back(std::log(T_z));
    of.error.push_back(error);
  }
  std::vector<AlphaBias> all;
  for (const auto& setting : settings) {
    const Points& of = points.at(setting);
    if (of.x.size() == scenes) all.push_back(fitted(setting.first, setting.second, of));
  }
  compare(all);
  return all;
}

CsvTable alpha_table(const std::vector<AlphaBias>& biases) {
  CsvTable table({{"axis", ""},
                  {"value", "1"},
                  {"alpha", "1"},
                  {"alpha_se", "1"},
                  {"alpha_bias", "1"},
                  {"alpha_bias_se", "1"}});
  for (const auto& one : biases) {
    table.add_row({one.axis, one.value, number_text(one.alpha), number_text(one.error),
                   number_text(one.bias), number_text(one.bias_error)});
  }
  return table;
}

}  // namespace shakebed::fitting::trade
