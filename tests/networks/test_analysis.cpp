#include <catch2/catch.hpp>
#include <cmath>

#include "fitting/networks/analysis.hpp"
#include "fitting/networks/tables.hpp"
#include "tests/networks/packing.hpp"

using namespace shakebed::tests;
using namespace shakebed::fitting::networks;

namespace {

const Snapshot& bed() {
  static const Snapshot one = packing({}, 61);
  return one;
}
const Analysis& analysis() {
  static const Analysis one = analyse(bed(), {});
  return one;
}

}  // namespace

TEST_CASE("the whole analysis recovers the law its forces were drawn from") {
  // Drawn from b = 0.68, beta = 1.35 and divided by their mean m = 1.0213 of that law: in scaled
  // form the tail decays with beta m = 1.379. 15,000 forces; 4 standard errors, once in 16,000.
  const auto& fit = analysis().all.by_likelihood;
  REQUIRE(fit.good());
  const double m = normalised(0.68, 1.35).mean();
  CHECK(std::abs(fit.law.beta - 1.35 * m) < 4 * fit.standard_error(2) + 0.02);
  CHECK(std::abs(fit.law.b - 0.68) < 4 * fit.standard_error(1) + 0.02);
  CHECK(fit.law.mean() == Approx(1).margin(0.005));
  CHECK(fit.chi_squared / fit.degrees_of_freedom < 2);

  // The caption's b = 0.68 fits such forces, the text's 0.83 does not.
  REQUIRE(analysis().published.size() == 3);
  CHECK(analysis().published[1].fit.log_likelihood >
        analysis().published[0].fit.log_likelihood + 100);
  CHECK(analysis().published[0].fit.chi_squared > 5 * analysis().published[1].fit.chi_squared);
}

TEST_CASE("trees favour strong contacts, and the preference fades with the passes") {
  // Deeper overlaps carry the larger forces and are the shorter edges: Figs 14 and 15.
  std::vector<double> means;
  for (const auto& pass : analysis().by_pass) {
    REQUIRE(pass.by_likelihood.good());
    means.push_back(pass.by_likelihood.law.mean());
  }
  REQUIRE(means.size() == 5);
  CHECK(means[0] > 1.2);
  CHECK(means[0] > means[1]);
  CHECK(means[1] > means[2]);
  CHECK(means[4] == Approx(1).margin(0.01));
  // F(r) of the passes settles on that of all contacts in the same way.
  const auto& all = analysis().correlation.back();
  const auto difference = [&](std::size_t pass) {
    double sum = 0;
    for (std::size_t bin = 10; bin < all.F.size(); ++bin) {
      sum += std::abs(analysis().correlation[pass].F[bin] - all.F[bin]);
    }
    return sum / static_cast<double>(all.F.size() - 10);
  };
  REQUIRE(analysis().correlation.size() == 6);
  CHECK(difference(0) > difference(1));
  CHECK(difference(1) > difference(2));
  CHECK(difference(4) < 0.01);
}

TEST_CASE("every table has the rows it should") {
  const auto all = tables(bed(), analysis());
  std::vector<std::string> stems;
  for (const auto& one : all) stems.push_back(one.stem);
  CHECK(stems == std::vector<std::string>{"networks", "contacts", "passes", "force_pdf",
                                          "force_fits", "correlation", "missing"});
  CHECK(all[0].table.rows() == analysis().networks.networks.size());
  CHECK(all[1].table.rows() == bed().contacts.size());
  CHECK(all[2].table.rows() == 6);
  CHECK(all[4].table.rows() == 7 * 4 + 3);
  CHECK(all[5].table.rows() == 6 * 60);
  CHECK(all[6].table.rows() == analysis().contacting.missing.size());

  // The share of captured contacts in the tables is that of the counts.
  const auto first = all[1].table.numbers("first_pass");
  const auto captured = std::ranges::count_if(first, [](double p) { return p <= 2; });
  const auto& row = analysis().contacting.passes[1];
  CHECK(static_cast<std::size_t>(captured) == row.NE + row.NE_rest);
  // P(f) times width, summed over a set, is 1.
  double sum = 0;
  const auto& pdf = all[3].table;
  for (std::size_t k = 0; k < pdf.rows(); ++k) {
    if (pdf.text(k, 0) == "all") sum += pdf.number(k, 4) * (pdf.number(k, 2) - pdf.number(k, 1));
  }
  CHECK(sum == Approx(1));
}

TEST_CASE("snapshots with nothing to analyse have a defined, empty result") {
  const auto place = [](std::size_t) { return std::string(); };
  const auto look = [&](const std::vector<GrainRow>& grains,
                        const std::vector<ContactRow>& contacts) {
    const auto snapshot = assemble("small", grains, place, contacts, place);
    const auto found = analyse(snapshot, {});
    CHECK(found.contacting.passes.size() == 5);
    CHECK(found.correlation.size() == 6);
    CHECK(tables(snapshot, found).size() == 7);
    return found;
  };
  const GrainRow one{1, {0, 0, 0}, 0.5}, two{2, {0.9, 0, 0}, 0.5}, three{3, {0, 0.9, 0}, 0.5};
  SECTION("one grain, also on a wall") {
    CHECK(look({one}, {}).networks.networks.empty());
    CHECK(look({one}, {{1, std::nullopt, 3}}).networks.networks.empty());
  }
  SECTION("no contacts, or none with force") {
    const auto found = look({one, two}, {});
    CHECK(found.networks.mean_force == 0);
    CHECK(!found.all.by_likelihood.good());
    CHECK(look({one, two}, {{1, 2, 0}}).networks.without_force == 1);
  }
  SECTION("forces that average to nothing or pull") {
    CHECK(look({one, two, three}, {{1, 2, 1}, {1, 3, -1}}).networks.networks.size() == 1);
    CHECK(look({one, two}, {{1, 2, -1}}).all.pulling == 1);
  }
  SECTION("one contact") {
    const auto found = look({one, two}, {{1, 2, 2.5}});
    CHECK(found.networks.networks.front().extent == 0.9);
    CHECK(found.contacting.passes[0].NP == 2);
    CHECK(!found.all.by_histogram.failure.empty());
  }
}
