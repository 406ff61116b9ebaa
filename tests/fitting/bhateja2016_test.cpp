// The shipped fit files, on synthetic beds whose truth is known.
#include <catch2/catch.hpp>
#include <cmath>

#include "fitting/exponents.hpp"
#include "fitting/fit.hpp"
#include "tests/fitting/table.hpp"

using namespace shakebed::fitting;

namespace {

FitReport run(const std::string& name) {
  return run_fits(read_fit_file(std::string(FIT_FILES) + "/" + name), collected_table(0.005, 61));
}

}  // namespace

TEST_CASE("table3.yaml compares with the paper's values and keeps the peak", "[bhateja2016]") {
  const auto report = run("table3.yaml");
  const auto rows = table3();
  std::size_t compared = 0;
  for (const auto& result : report.fits) {
    if (result.specification.reference.parameters.empty()) continue;
    const auto row = std::ranges::find_if(rows, [&](const Table3Row& candidate) {
      return candidate.system == result.labels[0].second &&
             candidate.model.name == result.specification.model.name;
    });
    REQUIRE(row != rows.end());
    ++compared;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& name = row->model.parameters[k];
      CHECK(result.specification.reference.parameters.at(name).value == row->abc[k]);
    }
    CHECK(result.specification.y == "T_z_twice_scaled");
    CHECK(result.measurements.points.front().W == W_at(600));
    CHECK(result.measurements.points.size() == 35);
  }
  CHECK(compared == 8);  // four rows, each with equal weights and with weights from errors
}

TEST_CASE("tables 1 and 2 find the exponents of known curves", "[bhateja2016]") {
  for (const auto& exponent : exponents(run("table2.yaml"))) {
    // dh_cm ~ W^0.7 = V_p^1.4 exactly, whatever the range
    CHECK(exponent.over_all.low == Approx(1.4).epsilon(1e-6));
    CHECK(exponent.over_all.high == Approx(1.4).epsilon(1e-6));
  }
  const auto first = run("table1.yaml");
  CHECK(exponents(first).size() == 6);
  for (const auto& exponent : exponents(first)) {
    const auto& specification = exponent.by_default->specification;
    if (specification.id != "feitosa_menon2002") continue;
    // local slope of a W + a c W^(1-b) against V_p at the middle of the range, Table III's 2D row
    const double W = std::sqrt(44 * 135.0);
    const double decay = 2.07 * std::pow(W, -0.656);
    const double slope = 2 * (1 + decay * (1 - 0.656)) / (1 + decay);
    CHECK(exponent.by_default->fit.values[1] == Approx(slope).margin(0.05));
  }
}
