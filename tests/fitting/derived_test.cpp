#include <catch2/catch.hpp>

#include "fitting/fit.hpp"
#include "fitting/tables.hpp"
#include "tests/figures/scratch.hpp"
#include "tests/fitting/table.hpp"

namespace shakebed::fitting {
namespace {

files::CsvTable table_of(const std::string& text, const files::CsvTable& data,
                         const std::string& name) {
  const auto file = read_fit_text("fit: 1\nid: f\n" + text, "f.yaml");
  for (const auto& [known, table] : tables(file, run_fits(file, data), data)) {
    if (known == name) return table;
  }
  return {};
}

}  // namespace

TEST_CASE("A ratio of two columns has the quadrature of their relative errors") {
  const auto data = collected_table(0.01, 5);
  const auto table =
      table_of("ratios: [{id: r, of: T_z_twice_scaled, over: delta_h_cm}]\n", data, "ratios");
  REQUIRE(table.rows() == data.rows());
  CHECK(table.columns()[table.column("r")].unit == "m V_p^2/(d)");
  const std::size_t row = 10;
  const double y = data.number(row, data.column("T_z_twice_scaled"));
  const double h = data.number(row, data.column("delta_h_cm"));
  CHECK(table.number(row, table.column("r")) == Approx(y / h));
  const double relative =
      std::hypot(data.number(row, data.column("T_z_twice_scaled_se")) / y, 0.01);
  CHECK(table.number(row, table.column("r_se")) == Approx(y / h * relative));
  CHECK(table.text(row, table.column("system")) == data.text(row, data.column("system")));
}

TEST_CASE("A ratio against another row finds it by the columns that match") {
  const auto data = collected_table(0.01, 5);
  const auto table =
      table_of("ratios: [{id: r, of: T_z, against: {system: 2D rough}, match: [frequency_rpm]}]\n",
               data, "ratios");
  const std::size_t half = data.rows() / 2;
  const auto value = [&](std::size_t row) { return table.number(row, table.column("r")); };
  const std::size_t column = data.column("T_z");
  CHECK(data.text(0, data.column("system")) == "2D rough");
  CHECK(value(20) == 1);
  CHECK(value(half + 20) == Approx(data.number(half + 20, column) / data.number(20, column)));
}

TEST_CASE("A collapsed curve passes through (1, 1) near its peak") {
  const auto data = collected_table(0.001, 5);
  const auto table =
      table_of("peaks: [{id: p, y: T_z_twice_scaled, for_each: [system]}]\n", data, "collapse");
  double nearest = 9;
  double height = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double x = table.number(row, table.column("W_over_W_f"));
    if (std::abs(x - 1) >= std::abs(nearest - 1)) continue;
    nearest = x;
    height = table.number(row, table.column("y_over_peak"));
  }
  CHECK(nearest == Approx(1).margin(0.1));
  CHECK(height == Approx(1).margin(0.03));
}

TEST_CASE("A point that was not run does not bound a peak from below") {
  const auto whole = collected_table(0.001, 5);
  files::CsvTable data([&] {
    auto columns = whole.columns();
    columns.push_back({"replicates", "1"});
    return columns;
  }());
  data.name = "collected.csv";
  // The peak lies at W = 2; all below W = 4 are at rest, or were not run.
  const auto with_replicates_below = [&](const char* replicates) {
    files::CsvTable table(data.columns());
    for (std::size_t row = 0; row < whole.rows(); ++row) {
      std::vector<std::string> cells;
      for (std::size_t k = 0; k < whole.columns().size(); ++k) cells.push_back(whole.text(row, k));
      const bool below = whole.number(row, whole.column("W")) < 4;
      if (below) cells[whole.column("T_z_twice_scaled")] = "";
      cells.push_back(below ? replicates : "1");
      table.add_row(std::move(cells));
    }
    return table;
  };
  const auto file = read_fit_text(
      "fit: 1\nid: f\npeaks: [{id: p, y: T_z_twice_scaled, select: {system: 2D rough}}]\n",
      "f.yaml");
  CHECK(run_fits(file, with_replicates_below("1")).peaks.front().peak);
  CHECK_THROWS_WITH(run_fits(file, with_replicates_below("0")),
                    Catch::Contains("nothing was measured below"));
}

TEST_CASE("The ranges of earlier studies come from their one table") {
  const tests::ScratchFolder folder;
  folder.file("studies.csv",
              "key [],W_from [1],W_to [1],provenance []\n"
              "warr,0.5,9,given\nyang,2,20,reconstructed\n");
  const auto here = folder.path() / "f.yaml";
  const auto file = read_fit_text(
      "fit: 1\nid: f\nstudies: studies.csv\ndefaults: {x: V_p, y: T_z, model: power_law}\n"
      "fits: [{id: a, range: {study: warr}}, {id: b, range: {study: yang}}]\n",
      here);
  CHECK(file.fits[0].range.from.number == 0.5);
  CHECK(file.fits[0].range.certain);
  CHECK(file.fits[0].range.stretch.empty());
  CHECK(file.fits[1].range.to.number == 20);
  CHECK_FALSE(file.fits[1].range.certain);
  CHECK(file.fits[1].range.stretch == std::vector<double>{0.7, 1.4});
  CHECK_THROWS_WITH(
      read_fit_text("fit: 1\nid: f\nstudies: studies.csv\nfits: [{id: a, x: V_p, y: T_z, model: "
                    "power_law, range: {study: huntley}}]\n",
                    here),
      Catch::Contains("no study 'huntley'"));
}

}  // namespace shakebed::fitting
