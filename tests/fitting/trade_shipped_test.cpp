#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "files/atomic_file.hpp"
#include "fitting/fit.hpp"
#include "fitting/fit_file.hpp"
#include "fitting/trade/bias_law.hpp"
#include "fitting/trade/promises.hpp"

// What is shipped under data/trade belongs together.
namespace {

using namespace shakebed;
using namespace shakebed::fitting;

const std::string folder = TRADE_DATA;

TEST_CASE("The settings that accuracy chooses from are those of the shipped trade table") {
  const auto trade = files::CsvTable::read(folder + "/trade.csv");
  CHECK(trade::accuracy_table(trade).to_text() == files::read_text(folder + "/accuracy.csv"));
}

TEST_CASE("The shipped runs on unseen scenes keep their promises, as 95 % would") {
  const auto kept = trade::kept_promises(files::CsvTable::read(folder + "/unseen.csv"),
                                         files::CsvTable::read(folder + "/unseen_references.csv"));
  CHECK(trade::promises_table(kept).to_text() == files::read_text(folder + "/promises.csv"));
  REQUIRE(kept.size() >= 6);  // five scenes and their sum
  CHECK(kept.back().runs >= 100);
  CHECK(kept.back().chance > 0.01);
}

bool is_of(const FitResult& fit, const std::string& scene) {
  return std::ranges::any_of(fit.labels, [&](const auto& label) { return label.second == scene; });
}

/// The freely fitted order b of T_z = a (1 + c v^-b) on one scene, with its standard error.
std::pair<double, double> order_of(const FitReport& report, const std::string& id,
                                   const std::string& scene) {
  for (const auto& fit : report.fits) {
    if (fit.specification.id != id || !is_of(fit, scene)) continue;
    REQUIRE(fit.fitted());
    return {fit.fit.values[1], std::sqrt(fit.fit.covariance(1, 1))};
  }
  FAIL("no fit " << id << " of " << scene);
  return {};
}

TEST_CASE("Left free, the order in dt is two and not one, that in k_n one half") {
  // The scene measured best. Four standard errors: false alarm 6e-5 each, were the data not fixed.
  const auto file = read_fit_file(std::string(TRADE_FITS) + "/orders.yaml");
  const auto report = run_fits(file, files::CsvTable::read(folder + "/trade.csv"));
  const auto [steps, steps_error] = order_of(report, "steps-stepped", "rough3d-peak");
  CHECK(std::abs(steps - 2) < 4 * steps_error);
  CHECK(steps - 1 > 2 * steps_error);
  const auto [stiffness, stiffness_error] = order_of(report, "stiffness", "rough3d-peak");
  CHECK(std::abs(stiffness - 0.5) < 4 * stiffness_error);
  CHECK(stiffness_error < 0.2);
}

}  // namespace
