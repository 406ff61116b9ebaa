#include "fitting/trade/promises.hpp"

#include <catch2/catch.hpp>

namespace {

using namespace shakebed;
using namespace shakebed::fitting;

TEST_CASE("Promises are counted, and the chance is that of the binomial distribution") {
  files::CsvTable runs({{"scene", ""}, {"asked", ""}, {"T_z", "m g d"}});
  for (const char* T_z : {"1.96", "2.0", "2.04", "2.2"}) runs.add_row({"bed", "5 %", T_z});
  runs.add_row({"bed", "5 %", ""});  // not run
  files::CsvTable references({{"scene", ""}, {"T_z", "m g d"}, {"T_z_se", "m g d"}});
  references.add_row({"bed", "2", "0.004"});
  const auto kept = trade::kept_promises(runs, references);
  REQUIRE(kept.size() == 2);
  CHECK(kept[0].runs == 4);
  CHECK(kept[0].kept == 3);
  CHECK(kept[0].mean_error == Approx(0.025));
  CHECK(kept[0].largest_error == Approx(0.1));
  CHECK(kept[0].reference_error == Approx(0.002));
  // P(X <= 3) of 4 at 0.95 is 1 - 0.95^4.
  CHECK(kept[0].chance == Approx(1 - 0.95 * 0.95 * 0.95 * 0.95));
  CHECK(kept[1].scene == "all");
  CHECK(kept[1].runs == 4);
  runs.add_row({"another", "5 %", "1"});
  CHECK_THROWS_WITH(trade::kept_promises(runs, references), Catch::Contains("another"));
}

}  // namespace
