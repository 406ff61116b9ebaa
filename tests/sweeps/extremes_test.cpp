#include "sweeps/extremes.hpp"

#include <catch2/catch.hpp>

#include "tests/sweeps/small_sweep.hpp"

namespace {

using namespace shakebed;
using namespace shakebed::sweeps;

ExtremeList list_of(const tests::SmallSweep& small, const std::string& cases) {
  const auto file = small.folder.path() / "list.yaml";
  files::write_text(file, "extremes: 1\nid: small\nbase: scene.yaml\ncases:\n" + cases);
  return read_extremes(file);
}

const std::string two_cases =
    "  - {group: a, id: standard}\n"
    "  - {group: a, id: other, against: standard, within: 5 %}\n";

/// T_z/(m V_p^2) = 0.1 times `factor` with an error of 0.5 %, a ledger open by `gap`.
simulator::Record record_with(double factor, double gap, bool warned, bool stationary = true) {
  simulator::Record record;
  record.quantities = {{"T_z_scaled", "m V_p^2", {0.1 * factor, 0.0005 * factor}}};
  record.scalars = {{"dissipation", "m g d", 1000},
                    {"base_work", "m g d", 1000},
                    {"ledger_residual", "", 1000 * gap}};
  record.stationary = stationary;
  record.stationary_reason = stationary ? "halves agree" : "it drifts";
  if (warned) record.warnings = {"soft"};
  return record;
}

std::string verdict_of(const ExtremeList& list, const simulator::Record& other) {
  const auto table = extremes_table(list, {record_with(1, 0, false), other});
  return table.text(1, table.column("verdict"));
}

TEST_CASE("A case is right, wrong and said, or wrong and unsaid") {
  const tests::SmallSweep small;
  const auto list = list_of(small, two_cases);
  CHECK(verdict_of(list, record_with(1, 0, false)) == "right");
  CHECK(verdict_of(list, record_with(1.06, 0, false)) == "right");  // 6(0.7) %: within noise of 5 %
  CHECK(verdict_of(list, record_with(1.08, 0, false)) == "wrong, UNSAID");
  CHECK(verdict_of(list, record_with(1.08, 0, true)) == "wrong, said");
  CHECK(verdict_of(list, record_with(1, 0.009, false)) == "right");
  CHECK(verdict_of(list, record_with(1, 0.011, false)) == "wrong, UNSAID");
  CHECK(verdict_of(list, record_with(1, 0.011, false, false)) == "wrong, said");
  CHECK(verdict_of(list, record_with(1, 0, false, false)) == "no steady state, said");
  CHECK(verdict_of(list, record_with(std::nan(""), 0, false)) == "wrong, UNSAID");
}

TEST_CASE("A scene that is refused is a row with its fault; the list's own faults are errors") {
  const tests::SmallSweep small;
  const auto list = list_of(small, "  - {group: a, id: e = 0, set: {grains.restitution: 0}}\n");
  REQUIRE_FALSE(list.cases[0].scene);
  CHECK(runs_of(list).empty());
  const auto table = extremes_table(list, {std::nullopt});
  CHECK(table.text(0, table.column("verdict")) == "refused");
  CHECK_THAT(table.text(0, table.column("says")), Catch::Contains("grains.restitution"));
  CHECK_THROWS_WITH(list_of(small, "  - {group: a, id: x, against: y, within: 5 %}\n"),
                    Catch::Contains("no case is called `y`"));
  CHECK_THROWS_WITH(list_of(small, "  - {group: a, id: x, witin: 5 %}\n"),
                    Catch::Contains("witin"));
}

}  // namespace
