#include "sweeps/profiles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "sweeps/combine.hpp"

namespace shakebed::sweeps {
namespace {

using files::number_text;
using simulator::Estimate;
using simulator::Record;

/// Measured columns, whether or not the bed has them. An empty box has no temperature over time,
/// but counts as cold at an instant.
struct Measured {
  const char* name;
  const char* unit;
  bool needs_grains;
};
constexpr std::array<Measured, 6> measured{{{"grains_in_box", "1", false},
                                            {"phi", "1", false},
                                            {"T_x", "m g d", true},
                                            {"T_y", "m g d", true},
                                            {"T_z", "m g d", true},
                                            {"T_z_instant", "m g d", false}}};

constexpr std::size_t T_z = 4;

const simulator::ProfileColumn* column_of(const Record& record, const std::string& name) {
  for (const auto& column : record.profile.columns) {
    if (column.name == name) return &column;
  }
  return nullptr;
}

std::size_t box_at(const Record& record, double z) {
  const auto& boxes = record.profile.z;
  return std::size_t(std::ranges::find(boxes, z) - boxes.begin());
}

double cycles_of(const Record& record) {
  for (const auto& scalar : record.scalars) {
    if (scalar.name == "cycles") return scalar.value;
  }
  return 1;
}

/// One column at the box centred at z; NaN where no replicate knows it.
Estimate combined_at(const std::vector<Record>& replicates, const Measured& what, double z) {
  std::vector<Contribution> found;
  for (const auto& record : replicates) {
    const auto* column = column_of(record, what.name);
    if (column == nullptr) continue;
    const std::size_t box = box_at(record, z);
    const bool reached = box < record.profile.z.size();
    if (!reached && what.needs_grains) continue;
    const Estimate here =
        reached ? Estimate{column->mean[box], column->standard_error[box]} : Estimate{0, 0};
    // A box with fewer than two centres has no temperature; the record says 0.
    if (what.needs_grains && here.mean == 0) continue;
    found.push_back({here, cycles_of(record)});
  }
  return combine(found).estimate;
}

}  // namespace

ProfileTable::ProfileTable(const Grid& grid) {
  auto columns = grid.columns;
  const auto add_once = [&](const char* name, const char* unit) {
    const bool known = std::ranges::any_of(
        columns, [&](const files::CsvColumn& column) { return column.name == name; });
    if (!known) columns.push_back({name, unit});
  };
  for (const auto& [name, unit] :
       {std::pair{"W", "1"}, {"V_p", "sqrt(g d)"}, {"layers", "1"}, {"grains", "1"}}) {
    add_once(name, unit);
  }
  columns.push_back({"z", "d"});
  for (const auto& what : measured) {
    columns.push_back({what.name, what.unit});
    columns.push_back({std::string(what.name) + "_se", what.unit});
  }
  columns.insert(columns.end(), {{"T_z_twice_scaled", "m V_p^2"},
                                 {"T_z_twice_scaled_se", "m V_p^2"},
                                 {"stationary", "1"},
                                 {"at_rest", "1"}});
  table_ = files::CsvTable(std::move(columns));
}

void ProfileTable::add(const Point& point, const std::vector<Record>& replicates,
                       const store::TableRow& combined) {
  std::set<double> heights;
  for (const auto& record : replicates) {
    heights.insert(record.profile.z.begin(), record.profile.z.end());
  }
  const double V_p = point.scene.base.drive.peak_velocity();
  const auto grains = static_cast<double>(point.scene.grains.count);
  for (const double z : heights) {
    std::array<Estimate, measured.size()> here;
    for (std::size_t k = 0; k < measured.size(); ++k) {
      here[k] = combined_at(replicates, measured[k], z);
    }
    if (!(here[0].mean >= least_share_of_grains * grains)) continue;
    std::vector<std::string> cells = point.labels;
    const std::array<std::pair<const char*, double>, 4> known{
        {{"W", point.scene.W()},
         {"V_p", V_p},
         {"layers", point.scene.grains.layers},
         {"grains", grains}}};
    for (const auto& [name, value] : known) {
      if (table_.column(name) == cells.size()) cells.push_back(number_text(value));
    }
    cells.push_back(number_text(z));
    for (const auto& estimate : here) {
      cells.push_back(number_text(estimate.mean));
      cells.push_back(number_text(estimate.standard_error));
    }
    const double scale = 2 / (V_p * V_p);
    cells.push_back(number_text(here[T_z].mean * scale));
    cells.push_back(number_text(here[T_z].standard_error * scale));
    cells.push_back(number_text(combined.stationary_fraction));
    cells.push_back(number_text(combined.at_rest_fraction));
    table_.add_row(std::move(cells));
  }
}

}  // namespace shakebed::sweeps
