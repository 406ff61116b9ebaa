#include "figures/claims.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "tests/figures/one_figure.hpp"
#include "tests/figures/scratch.hpp"

using namespace shakebed;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

const std::string manifest_text = manifest_of_one_figure + R"yaml(
    claims:
      - {id: rises, says: y rises, source: Sec. 1, table: t, compute: "slope(x, y)", unit: "1", holds: {above: 0}, why: a rise}
)yaml";

/// A build folder's tables.csv with one table of each origin given as rows of x, y, y_se.
class Results {
 public:
  figures::PipelineTables tables() const {
    return figures::PipelineTables(folder.file("tables.csv", list_));
  }
  void add(const std::string& origin, const std::string& rows) {
    folder.file(origin + ".csv", "x [1],y [1],y_se [1]\n" + rows);
    list_ += origin + ",t," + origin + ".csv\n";
  }
  tests::ScratchFolder folder;

 private:
  std::string list_ = "origin,table,file\nshipped,u,nowhere.csv\n";
};

std::string verdict_of(const std::vector<figures::JudgedClaim>& judged, const std::string& origin) {
  return fitting::claims::text_of(judged.front().results.at(origin).verdict);
}

}  // namespace

TEST_CASE("Claims are judged over each origin by itself") {
  Results results;
  results.add("shipped", "1,1,0.1\n2,5,0.1\n");
  results.add("quick", "1,1,9\n2,5,9\n");
  results.add("paper", "1,5,0.1\n2,1,0.1\n");
  const auto manifest = figures::read_manifest(results.folder.file("m.yaml", manifest_text));
  const auto judged =
      figures::judge_claims(manifest, results.tables(), {"shipped", "quick", "paper"});
  CHECK(verdict_of(judged, "shipped") == "holds");
  CHECK(verdict_of(judged, "quick") == "not decided");
  CHECK(verdict_of(judged, "paper") == "differs");
  CHECK(figures::claims_table(judged).rows() == 3);
  CHECK_THAT(figures::claims_text(judged), Contains("1 holds"));

  // A profile that has computed nothing of what a claim needs is not mentioned; the shipped
  // averages always are.
  Results one_profile;
  one_profile.add("paper", "1,1,0.1\n2,5,0.1\n");
  const auto few =
      figures::judge_claims(manifest, one_profile.tables(), {"shipped", "quick", "paper"});
  CHECK(few.front().results.count("quick") == 0);
  CHECK(verdict_of(few, "shipped") == "not decided");
  CHECK(verdict_of(few, "paper") == "holds");
}

TEST_CASE("A changed verdict, a new and a lost claim are noticed") {
  Results results;
  results.add("shipped", "1,1,0.1\n2,5,0.1\n");
  const auto manifest = figures::read_manifest(results.folder.file("m.yaml", manifest_text));
  const auto judged = figures::judge_claims(manifest, results.tables(), {"shipped"});
  const auto recorded = figures::recorded_verdicts(judged);
  CHECK(figures::changes_since(recorded, judged).empty());

  const auto changed_text = [&](const std::string& line) {
    const auto file = results.folder.file("v.csv", "figure [],claim [],verdict []\n" + line);
    const auto changes = figures::changes_since(files::CsvTable::read(file), judged);
    return changes.empty() ? std::string() : changes.front();
  };
  CHECK(changed_text("p-fig1,rises,holds\n").empty());
  CHECK_THAT(changed_text("p-fig1,rises,differs\n"), Contains("recorded differs, now holds"));
  CHECK_THAT(changed_text("p-fig1,falls,holds\n"), Contains("not recorded, now holds"));
  CHECK_THAT(changed_text("p-fig1,rises,holds\np-fig2,rises,holds\n"),
             Contains("p-fig2/rises: recorded holds, no longer in the manifest"));
}
