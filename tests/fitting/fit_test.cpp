#include "fitting/fit.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "files/error.hpp"
#include "fitting/exponents.hpp"
#include "fitting/tables.hpp"
#include "tests/fitting/table.hpp"

using namespace shakebed::fitting;
using shakebed::files::CsvTable;

namespace {

FitReport run(const std::string& entries, const CsvTable& table) {
  return run_fits(read_fit_text("fit: 1\nid: f\n" + entries, "f.yaml"), table);
}

CsvTable table_named(const std::string& name, const std::string& entries, const CsvTable& data) {
  const auto file = read_fit_text("fit: 1\nid: f\n" + entries, "f.yaml");
  for (auto& [table_name, table] : tables(file, run_fits(file, data), data)) {
    if (table_name == name) return table;
  }
  return {};
}

const std::string algebraic_fit =
    "fits:\n"
    "  - id: 3d\n"
    "    select: {system: 3D rough}\n"
    "    x: W\n"
    "    y: T_z_twice_scaled\n"
    "    model: algebraic\n"
    "    range: {W: [peak, 89.5]}\n"
    "    reference: {a: 0.054, b: 0.622, c: 7.98, correlation: 0.9964, source: Table III}\n"
    "    compare_at: [5, 50]\n";

}  // namespace

TEST_CASE("a fit from the peak keeps the peak point and meets its truth", "[fit]") {
  const auto report = run(algebraic_fit, collected_table(0.01, 51));
  REQUIRE(report.fits.size() == 1);
  const auto& fit = report.fits[0];
  CHECK(fit.measurements.points.front().W == W_at(600));
  CHECK(fit.measurements.points.back().W == W_at(4000));
  const double truth[3] = {0.054, 0.622, 7.98};
  // 4 standard errors: false alarm of 3e-4 for the three together, once (the seed is fixed)
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(std::abs(fit.fit.values[k] - truth[k]) < 4 * fit.fit.standard_error(k));
  }
}

TEST_CASE("the comparison holds ours, the paper's and the paper's rounding", "[fit]") {
  const auto table = table_named("comparison", algebraic_fit, collected_table(0.01, 51));
  REQUIRE(table.rows() == 2);
  CHECK(table.columns()[table.column("y")].unit == "m V_p^2");
  const double paper = 0.054 * (1 + 7.98 * std::pow(5, -0.622));
  CHECK(table.numbers("reference_y")[0] == Approx(paper));
  // half a unit of a (0.0005 of 0.054) alone is 0.93 %
  CHECK(table.numbers("reference_rounding")[0] > 0.92);
  const double ours = table.numbers("y")[0];
  CHECK(table.numbers("difference")[0] == Approx(100 * (ours / paper - 1)));
  CHECK(table.numbers("difference_in_standard_errors")[0] ==
        Approx((ours - paper) / table.numbers("y_se")[0]));
}

TEST_CASE("methods, weights and stretched ranges are fitted one by one", "[fit]") {
  const std::string entry =
      "fits:\n  - {id: a, select: {system: 2D rough}, x: V_p, y: T_z, model: power_law,\n"
      "     method: [log_log, linear], weights: [equal, errors],\n"
      "     range: {W: [2, 20], known: uncertain, stretch: [0.7, 1.4]}}\n";
  const auto report = run(entry, collected_table(0.01, 52));
  CHECK(report.fits.size() == 2 * 2 * 3 * 3);
  CHECK(report.fits[0].variant.text() == "default");
  CHECK(report.fits[1].variant.text() == "log_log equal to x0.7");
  const auto all = exponents(report);
  REQUIRE(all.size() == 1);
  CHECK(all[0].variants == 36);
  const double alpha = report.fits[0].fit.values[1];
  CHECK(all[0].over_methods.low <= alpha);
  CHECK(all[0].over_methods.high >= alpha);
  // T_z/V_p^2 falls over the whole range, ever slower: a range at higher W has the larger alpha
  CHECK(all[0].over_ranges.low < alpha);
  CHECK(all[0].over_ranges.high > alpha);
  CHECK(all[0].over_all.low <= all[0].over_ranges.low);
  const auto table = table_named("exponents", entry, collected_table(0.01, 52));
  CHECK(table.text(0, table.column("range_known")) == "uncertain");
  CHECK(table.numbers("first_W")[0] == W_at(600));
  CHECK(table.numbers("last_W")[0] == W_at(1800));  // 1900 rpm is W = 20.2
}

// The spread of 400 estimates is known to 3.5 %; the four rules are within 15 % of it but once in
// 10,000 seeds. On this curve, which bends, the scatter about the line is about twice as large.
TEST_CASE("alpha's statistical error is its spread over tables that differ by their noise",
          "[fit]") {
  constexpr int tables = 400;
  std::array<double, 4> sum{}, square{}, stated{}, scatter{};
  const std::array<std::string, 4> rules{"log_log, weights: equal", "log_log, weights: errors",
                                         "linear, weights: equal", "linear, weights: errors"};
  for (int k = 0; k < tables; ++k) {
    const auto data = collected_table(0.01, static_cast<unsigned long>(1000 + k));
    for (std::size_t rule = 0; rule < rules.size(); ++rule) {
      const auto report =
          run("fits: [{id: a, select: {system: 3D rough}, x: V_p, y: T_z, model: power_law, "
              "range: {W: [2, 20]}, method: " +
                  rules[rule] + "}]\n",
              data);
      const auto exponent = exponents(report).front();
      const double alpha = report.fits[0].fit.values[1];
      sum[rule] += alpha;
      square[rule] += alpha * alpha;
      stated[rule] += exponent.statistical_error / tables;
      scatter[rule] += report.fits[0].fit.standard_error(1) / tables;
    }
  }
  for (std::size_t rule = 0; rule < rules.size(); ++rule) {
    const double mean = sum[rule] / tables;
    const double spread = std::sqrt((square[rule] - tables * mean * mean) / (tables - 1));
    CAPTURE(rules[rule], spread, stated[rule], scatter[rule]);
    CHECK(stated[rule] == Approx(spread).epsilon(0.15));
    if (rule == 0) CHECK(scatter[rule] > 1.5 * spread);
  }
}

TEST_CASE("AICc is compared between forms of the same points only", "[fit]") {
  const std::string entries =
      "defaults: {select: {system: 2D rough}, y: T_z_twice_scaled, range: {W: [peak, 89.5]}}\n"
      "fits:\n"
      "  - {id: algebraic, x: W, model: algebraic}\n"
      "  - {id: exponential, x: W, model: exponential}\n"
      "  - {id: equation6, x: V_p, model: two_power_scaled}\n"
      "  - {id: other-range, x: W, model: exponential, range: {W: [10, 89.5]}}\n";
  const auto fits = run(entries, collected_table(0.01, 53)).fits;
  CHECK(*fits[0].delta_aicc == Approx(0).margin(1e-6));
  CHECK(*fits[1].delta_aicc > 10);
  CHECK(*fits[2].delta_aicc == Approx(0).margin(1e-6));  // Eq. 6 is the algebraic form rewritten
  CHECK(*fits[3].delta_aicc == 0);
  CHECK(fits[2].fit.values[2] == Approx(2 - 2 * fits[0].fit.values[1]).epsilon(1e-5));
}

TEST_CASE("for_each makes one fit a group and reports the one that fails", "[fit]") {
  auto data = collected_table(0.01, 54);
  for (std::size_t row = 48 + 3; row < 96; ++row) data = with_cell(data, row, "stationary", "0");
  const std::string entry =
      "fits:\n  - {id: a, for_each: [system], x: V_p, y: T_z, model: power_law}\n";
  const auto report = run(entry, data);
  REQUIRE(report.fits.size() == 2);
  CHECK(report.fits[0].fitted());
  CHECK(report.fits[0].labels == Labels{{"system", "2D rough"}});
  CHECK_FALSE(report.fits[1].fitted());
  CHECK_THAT(report.fits[1].problem, Catch::Contains("1 point for the 2 parameters"));
  const auto summary = table_named("summary", entry, data);
  CHECK(summary.text(1, summary.column("system")) == "3D rough");
  CHECK_FALSE(summary.text(1, summary.column("problem")).empty());
  CHECK(table_named("parameters", entry, data).rows() == 2);
}

TEST_CASE("a fit that cannot be made is refused with its place and id", "[fit]") {
  const auto data = collected_table(0.01, 55);
  const auto entry = [](const std::string& more) {
    return "fits:\n  - {id: a, select: {system: 2D rough}, x: W, y: T_z_scaled, " + more + "}\n";
  };
  const auto has = [](const std::string& text) { return Catch::Contains(text); };
  CHECK_THROWS_WITH(run(entry("model: algebraic, range: {W: [80, 86]}"), data),
                    has("f.yaml:4:") && has("a: ") &&
                        has("2 points for the 3 parameters of algebraic; expected at least 4"));
  CHECK_THROWS_WITH(run(entry("model: algebraic, range: {W: [200, 300]}"), data), has("0 points"));
  CHECK_THROWS_WITH(run(entry("model: algebraic, peak_of: nothing, range: {W: [peak, end]}"), data),
                    has("nothing"));
  const auto zero = with_cell(data, 10, "T_z_scaled_se", "0");
  CHECK_THROWS_WITH(run(entry("model: algebraic, range: {W: [2, end]}"), zero),
                    has("T_z_scaled_se = 0") && has("weights: equal"));
  const auto empty = with_cell(data, 10, "T_z_scaled_se", "");
  CHECK_THROWS_WITH(run(entry("model: algebraic, range: {W: [2, end]}"), empty), has("(empty)"));
  CHECK(
      run(entry("model: algebraic, range: {W: [2, end]}, weights: equal"), zero).fits[0].fitted());
  CHECK_THROWS_WITH(run(entry("model: algebraic, y_error: T_z_sem"), data), has("T_z_sem"));
}

TEST_CASE("if_impossible: report keeps the other fits, unless there are none", "[fit]") {
  const auto data = collected_table(0.01, 55);
  const std::string entries =
      "defaults: {select: {system: 2D rough}, x: V_p, y: T_z, model: power_law,\n"
      "           if_impossible: report}\n"
      "fits:\n"
      "  - {id: a, range: {W: [200, 300]}}\n";
  CHECK_THROWS_WITH(run(entries, data),
                    Catch::Contains("nothing in this file") && Catch::Contains("a: 0 points"));
  const auto fits = run(entries + "  - {id: b, range: {W: [2, 20]}}\n", data).fits;
  CHECK_THAT(fits[0].problem, Catch::Contains("0 points"));
  CHECK(fits[1].fitted());
}

TEST_CASE("peaks and their settling become rows", "[fit]") {
  const auto table =
      table_named("parameters", "peaks:\n  - {id: p, for_each: [system], y: T_z_twice_scaled}\n",
                  collected_table(0.01, 56));
  REQUIRE(table.rows() == 6);
  CHECK(table.text(0, table.column("parameter")) == "W_f");
  CHECK(table.text(1, table.column("parameter")) == "peak_height");
  CHECK(table.text(1, table.column("unit")) == "m V_p^2");
  CHECK(table.text(2, table.column("parameter")) == "W_2");
  const double W_f = table.numbers("value")[0];
  CHECK(W_f > W_at(500));
  CHECK(W_f < W_at(700));
}

TEST_CASE("curves stay inside their range and meet the fit", "[fit]") {
  const auto data = collected_table(0.01, 51);
  const auto curves = table_named("curves", algebraic_fit, data);
  CHECK(curves.rows() == 400);  // ours and the paper's
  CHECK(curves.numbers("x").front() == Approx(W_at(600)));
  CHECK(curves.numbers("x")[199] == Approx(W_at(4000)));
  const auto fit = run(algebraic_fit, data).fits[0];
  CHECK(curves.numbers("y").front() == Approx(fit.fit.fitted.front()));
  CHECK(curves.numbers("lower95").front() < curves.numbers("y").front());
  CHECK(curves.text(200, curves.column("curve")) == "reference");
  CHECK(curves.numbers("y")[200] == Approx(0.054 * (1 + 7.98 * std::pow(W_at(600), -0.622))));
}

TEST_CASE("the same data give the same tables", "[fit]") {
  const auto data = collected_table(0.01, 57);
  const std::string entries =
      algebraic_fit + "peaks:\n  - {id: p, select: {system: 2D rough}, y: T_z_scaled}\n";
  for (const auto* name : {"parameters", "summary", "curves", "points"}) {
    const auto once = table_named(name, entries, data);
    CHECK(once.to_text() == table_named(name, entries, data).to_text());
    CHECK(once.provenance == std::vector<std::string>{"sweep: synthetic", "fit: f"});
  }
}

TEST_CASE("tables go beside the parameters", "[fit]") {
  CHECK(table_path("out/parameters.csv", "curves") == "out/curves.csv");
  CHECK(table_path("out/t3.csv", "curves") == "out/t3.curves.csv");
  CHECK(table_path("out/t3.csv", "parameters") == "out/t3.csv");
}

TEST_CASE("errors weigh residuals as 1/sigma^2, and those of ln y as y^2/sigma^2", "[fit]") {
  auto data = collected_table(0.01, 58);
  data = with_cell(data, 12, "T_z_se", "0.5");  // unequal relative errors
  const auto report =
      run("fits:\n  - {id: a, select: {system: 2D rough}, x: V_p, y: T_z, model: power_law,\n"
          "     method: [log_log, linear], range: {W: [2, 20]}}\n",
          data);
  for (const auto& result : report.fits) {
    double sum = 0;
    for (std::size_t i = 0; i < result.measurements.points.size(); ++i) {
      const Point& point = result.measurements.points[i];
      const double fitted = result.fit.fitted[i];
      const double in_errors = result.variant.method == Method::log_log
                                   ? std::log(point.y / fitted) * point.y / point.error
                                   : (point.y - fitted) / point.error;
      sum += in_errors * in_errors;
    }
    CHECK(result.fit.chi_squared == Approx(sum).epsilon(1e-9));
  }
}
