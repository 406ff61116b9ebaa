#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "fitting/networks/ensemble.hpp"
#include "tests/networks/packing.hpp"

using namespace shakebed;
using namespace shakebed::tests;
using namespace shakebed::fitting::networks;

namespace {

Member member(std::uint64_t seed) {
  PackingOptions small;
  small.small_grains = 300;
  small.cylinder_diameter = 6;
  Member one{packing(small, seed), {}};
  one.analysis = analyse(one.snapshot, {});
  return one;
}

const files::CsvTable& named(const std::vector<NamedTable>& tables, const std::string& stem) {
  for (const auto& one : tables) {
    if (one.stem == stem) return one.table;
  }
  throw files::failed(stem, "is not among the tables");
}

}  // namespace

TEST_CASE("an ensemble gives mean and spread of every number, beside the paper's") {
  Ensemble ensemble(std::vector<files::CsvColumn>{{"mu_wall", "1"}});
  const Member a = member(1), b = member(2);
  const auto contacts = [](const Member& one) {
    return static_cast<double>(one.analysis.networks.networks.front().contacts.size());
  };
  // T = 10.5 comes first, and is not what distributions are made of.
  ensemble.add({"0.5"}, 10.5, member(3));
  ensemble.add({"0.5"}, 10, a);
  ensemble.add({"0.5"}, 10, b);
  files::CsvTable reference({{"mu_wall", ""}, {"quantity", ""}, {"paper", ""}, {"source", ""}});
  reference.add_row({"0.5", "largest_contacts", "11533", "Table II"});
  reference.add_row({"0", "NE_1", "1", "another bed"});
  reference.add_row({"0.5", "NE_1", "5795", "Table II"});
  const auto tables = ensemble.tables(reference);

  const auto& cycle = named(tables, "cycle");
  REQUIRE(cycle.rows() == 2);
  CHECK(cycle.numbers("T") == std::vector<double>{10, 10.5});
  CHECK(cycle.numbers("replicas") == std::vector<double>{2, 1});
  const double mean = 0.5 * (contacts(a) + contacts(b));
  const double sd = std::abs(contacts(a) - contacts(b)) / std::sqrt(2.0);
  CHECK(cycle.numbers("largest_contacts")[0] == Approx(mean));
  CHECK(cycle.numbers("largest_contacts_sd")[0] == Approx(sd));
  CHECK(cycle.numbers("largest_contacts_se")[0] == Approx(sd / std::sqrt(2.0)));
  CHECK(std::isnan(cycle.numbers("largest_contacts_se")[1]));

  const auto& numbers = named(tables, "numbers");
  bool found = false;
  for (std::size_t row = 0; row < numbers.rows(); ++row) {
    if (numbers.text(row, numbers.column("quantity")) != "largest_contacts") continue;
    found = true;
    CHECK(numbers.number(row, numbers.column("mean")) == Approx(mean));
    CHECK(numbers.text(row, numbers.column("paper")) == "11533");
  }
  CHECK(found);

  const auto& passes = named(tables, "passes");
  REQUIRE(passes.rows() == 6);
  CHECK(passes.text(5, passes.column("passes")) == "network");
  CHECK(passes.text(0, passes.column("NE_paper")) == "5795");
  CHECK(passes.numbers("NE")[5] == Approx(mean));
  CHECK(passes.numbers("missing")[5] == 0);

  // The first replica of the earliest instant is the one that is drawn.
  const auto& networks = a.analysis.networks;
  const auto strong = std::count_if(
      networks.contacts.begin(), networks.contacts.end(),
      [&](Index k) { return a.snapshot.contacts[k].normal_force > networks.mean_force; });
  CHECK(named(tables, "edges").rows() == static_cast<std::size_t>(strong));
  const auto& grains = named(tables, "grains");
  REQUIRE(grains.rows() == a.snapshot.grains());
  CHECK(grains.numbers("z")[7] == a.snapshot.position[7][2]);
}

TEST_CASE("the distribution of an ensemble integrates to one, set by set") {
  Ensemble ensemble(std::vector<files::CsvColumn>{{"mu_wall", "1"}});
  ensemble.add({"0.5"}, 10, member(1));
  ensemble.add({"0.5"}, 10, member(2));
  const auto tables = ensemble.tables({});
  const auto& pdf = named(tables, "pdf");
  std::map<std::string, double> integral, weak;
  for (std::size_t row = 0; row < pdf.rows(); ++row) {
    const double P = pdf.number(row, pdf.column("P"));
    const auto& set = pdf.text(row, pdf.column("set"));
    integral[set] += 0.1 * P;
    if (pdf.number(row, pdf.column("f")) < 0.5) weak[set] += 0.1 * P;
  }
  CHECK(integral.size() == 6);
  // Forces above ten times the mean are beyond the table: exp(-13.5) of them.
  for (const auto& [set, value] : integral) CHECK(value == Approx(1).margin(1e-3));
  // Larger forces sit at deeper overlaps, whose edges are the shorter ones.
  CHECK(weak["pass 1"] < 0.9 * weak["all"]);
  CHECK(weak["pass 5"] == Approx(weak["all"]).margin(0.02));
  const auto& correlation = named(tables, "correlation");
  CHECK(correlation.rows() == 6 * 60);

  // Bed by bed, the ratio's mean is that of the parts to first order, and its error far smaller.
  const auto& cycle = named(tables, "cycle");
  CHECK(cycle.numbers("weak_over_all_1")[0] == Approx(weak["pass 1"] / weak["all"]).epsilon(0.03));
  CHECK(cycle.numbers("below_mean_over_all_5")[0] == Approx(1).margin(0.01));
  std::map<std::string, double> near;
  for (std::size_t row = 0; row < correlation.rows(); ++row) {
    const double r = correlation.number(row, correlation.column("r"));
    if (r < 0.5 || r > 3) continue;
    near[correlation.text(row, correlation.column("set"))] +=
        correlation.number(row, correlation.column("F"));
  }
  for (const char* pass : {"1", "3"}) {
    CHECK(cycle.numbers(std::string("F_near_over_all_") + pass)[0] ==
          Approx(near[std::string("pass ") + pass] / near["all"]).epsilon(0.03));
  }
  CHECK(cycle.numbers("theta_less_all_1")[0] > cycle.numbers("theta_less_all_5")[0]);
}

TEST_CASE("what Sun 2006 prints of the passes is Eq. 13 with its shifts") {
  // a (1 - b exp(-(f - theta)^2)) exp(-beta (f - lambda)) at f = 1 for one pass, whole range.
  const auto law = published_law_of_pass(1);
  REQUIRE(law.whole);
  const double shifted = 2.2 * (1 - 0.9 * std::exp(-0.75 * 0.75)) * std::exp(-1.35 * 0.5);
  CHECK(law.whole->density(1) == Approx(shifted));
  CHECK(published_law_of_pass(0).whole->density(1) ==
        Approx(2.46 * (1 - 0.68 * std::exp(-1.0)) * std::exp(-1.35)));
  CHECK_FALSE(published_law_of_pass(4).other);
}
