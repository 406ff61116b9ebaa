#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "fitting/tables.hpp"

namespace shakebed::fitting {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
using Cells = std::vector<std::string>;

inline std::string cell(double value) {
  return std::isfinite(value) ? files::number_text(value) : "";
}
inline std::string cell(std::optional<double> value) { return value ? cell(*value) : ""; }
inline std::string cell(std::size_t count) { return std::to_string(count); }

/// The columns that every table begins with: fit, variant, the labels' columns, model.
class Head {
 public:
  explicit Head(const FitReport& report) {
    for (const auto& result : report.fits) learn(result.labels);
    for (const auto& result : report.peaks) learn(result.labels);
  }

  files::CsvTable table(std::initializer_list<files::CsvColumn> columns) const {
    std::vector<files::CsvColumn> all{{"fit", ""}, {"variant", ""}};
    for (const auto& name : names_) all.push_back({name, ""});
    all.push_back({"model", ""});
    all.insert(all.end(), columns);
    return files::CsvTable(std::move(all));
  }

  void add(files::CsvTable& table, const FitResult& result, Cells cells) const {
    add(table, result.specification.id, result.variant.text(), result.labels,
        result.specification.model.name, std::move(cells));
  }
  void add(files::CsvTable& table, const PeakResult& result, Cells cells) const {
    add(table, result.specification.id, "default", result.labels, "peak", std::move(cells));
  }

 private:
  void learn(const Labels& labels) {
    for (const auto& [name, value] : labels) {
      if (std::ranges::find(names_, name) == names_.end()) names_.push_back(name);
    }
  }
  void add(files::CsvTable& table, const std::string& fit, const std::string& variant,
           const Labels& labels, const std::string& model, Cells cells) const {
    Cells row{fit, variant};
    for (const auto& name : names_) {
      const auto label = std::ranges::find(labels, name, &Labels::value_type::first);
      row.push_back(label == labels.end() ? "" : label->second);
    }
    row.push_back(model);
    row.insert(row.end(), cells.begin(), cells.end());
    table.add_row(std::move(row));
  }
  std::vector<std::string> names_;
};

files::CsvTable parameters_table(const Head& head, const FitReport& report);
files::CsvTable summary_table(const Head& head, const FitReport& report);
files::CsvTable exponents_table(const Head& head, const FitReport& report);
files::CsvTable curves_table(const Head& head, const FitReport& report);
files::CsvTable comparison_table(const Head& head, const FitReport& report);
files::CsvTable correlations_table(const Head& head, const FitReport& report);
files::CsvTable points_table(const Head& head, const FitReport& report);
files::CsvTable collapse_table(const Head& head, const FitReport& report);
files::CsvTable ratios_table(const FitFile& file, const files::CsvTable& data);

}  // namespace shakebed::fitting
