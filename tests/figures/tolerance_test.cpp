#include <catch2/catch.hpp>
#include <cmath>

#include "figures/manifest.hpp"
#include "files/csv.hpp"

using namespace shakebed;
namespace fs = std::filesystem;

namespace {

/// "bhateja2016-table3.comparison" -> .../fits/bhateja2016-table3/comparison.csv
files::CsvTable fit_table(const std::string& name) {
  const auto dot = name.rfind('.');
  REQUIRE(dot != std::string::npos);
  return files::CsvTable::read(fs::path(SHAKEBED_SHIPPED_RESULTS) / "fits" / name.substr(0, dot) /
                               (name.substr(dot + 1) + ".csv"));
}

double our_value(const figures::OurValue& ours) {
  const auto table = fit_table(ours.table);
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    bool wanted = true;
    for (const auto& [column, word] : ours.row) {
      wanted = wanted && table.text(row, table.column(column)) == word;
    }
    if (wanted) rows.push_back(row);
  }
  REQUIRE(rows.size() == 1);
  return table.number(rows.front(), table.column(ours.column));
}

}  // namespace

TEST_CASE("shipped averages agree with the papers within the manifest's tolerances") {
  int compared = 0;
  const auto manifest =
      figures::read_manifest(fs::path(SHAKEBED_SOURCE_DIR) / "data_manifest.yaml");
  for (const auto& entry : manifest.entries) {
    for (const auto& reference : entry.values) {
      if (!reference.ours) continue;
      const double ours = our_value(*reference.ours);
      const auto& tolerance = *reference.tolerance;
      const double allowed = tolerance.kind == figures::Tolerance::Kind::relative
                                 ? tolerance.value * std::abs(*reference.value)
                                 : tolerance.value;
      CAPTURE(entry.id, reference.name, ours, *reference.value, allowed);
      CHECK(std::abs(ours - *reference.value) <= allowed);
      ++compared;
    }
  }
  CHECK(compared > 0);
}
