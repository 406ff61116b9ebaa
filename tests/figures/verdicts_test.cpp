#include <catch2/catch.hpp>

#include "figures/claims.hpp"

using namespace shakebed;
namespace fs = std::filesystem;

// The shipped averages, their fits and the claims decide the verdicts, so a change is a change of
// one of these: `make record-claims` keeps the new verdicts, and CHANGELOG.md says why they moved.
TEST_CASE("verdicts from the shipped averages are the recorded ones") {
  const fs::path source = SHAKEBED_SOURCE_DIR;
  const auto manifest = figures::read_manifest(source / "data_manifest.yaml");
  const figures::PipelineTables tables(fs::path(SHAKEBED_BINARY_DIR) / "tables.csv");
  const auto judged = figures::judge_claims(manifest, tables, {"shipped"});
  REQUIRE(judged.size() > 20);
  const auto recorded = files::CsvTable::read(source / "data" / "verdicts.csv");
  for (const auto& change : figures::changes_since(recorded, judged)) FAIL_CHECK(change);
}
