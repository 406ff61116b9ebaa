#include <catch2/catch.hpp>
#include <cmath>

#include "fitting/networks/components.hpp"
#include "fitting/networks/extent.hpp"
#include "tests/networks/packing.hpp"

using namespace shakebed::tests;
using namespace shakebed::fitting::networks;

namespace {

Snapshot hand_made(const std::vector<Point>& centres, const std::vector<ContactRow>& contacts) {
  std::vector<GrainRow> grains;
  for (std::size_t k = 0; k < centres.size(); ++k) {
    grains.push_back({static_cast<std::int64_t>(k), centres[k], 0.5});
  }
  const auto place = [](std::size_t row) { return "row " + std::to_string(row); };
  return assemble("hand made", grains, place, contacts, place);
}

double brute_extent(const std::vector<Point>& points) {
  double longest = 0;
  for (const auto& a : points) {
    for (const auto& b : points) longest = std::max(longest, distance(a, b));
  }
  return longest;
}

}  // namespace

TEST_CASE("networks of a hand-made bed") {
  // 0-1-2-3 in a square with a diagonal (0-2), 4-5 apart, 6 on a wall only, 7-8 without force,
  // 9-10 pulling.
  const auto bed = hand_made({{0, 0, 0},
                              {1, 0, 0},
                              {1, 1, 0},
                              {0, 1, 0},
                              {5, 0, 0},
                              {6, 0, 0},
                              {9, 0, 0},
                              {9, 5, 0},
                              {9, 6, 0},
                              {0, 9, 0},
                              {1, 9, 0}},
                             {{0, 1, 4},
                              {1, 2, 1},
                              {2, 3, 3},
                              {3, 0, 1},
                              {2, 0, 1},
                              {5, 4, 7},
                              {6, std::nullopt, 2},
                              {0, std::nullopt, 9},
                              {4, std::nullopt, 9},
                              {7, 8, 0},
                              {9, 10, -0.5}});
  const auto found = force_networks(bed);

  CHECK(bed.wall_contacts == 3);
  CHECK(found.pulling == 1);
  CHECK(found.without_force == 1);
  CHECK(found.contacts.size() == 7);
  CHECK(found.mean_force == Approx((4 + 1 + 3 + 1 + 1 + 7 - 0.5) / 7));

  // Walls join nothing: 0 and 4 both press on one.
  REQUIRE(found.networks.size() == 3);
  const auto& largest = found.networks[0];
  CHECK(largest.grains == std::vector<Index>{0, 1, 2, 3});
  CHECK(largest.contacts.size() == 5);
  CHECK(largest.coordination == 2.5);
  CHECK(largest.extent == std::sqrt(2.0));
  CHECK(largest.mean_force == 2);
  // Above the mean of 2: 0-1 and 2-3, which do not touch each other's grains.
  CHECK(largest.strong_contacts == 2);
  CHECK(largest.strong_grains == 2);
  CHECK(largest.grains_with_strong_contact == 4);

  CHECK(found.networks[1].grains == std::vector<Index>{4, 5});
  CHECK(found.networks[1].strong_contacts == 0);
  CHECK(found.networks[1].strong_grains == 0);
  CHECK(found.networks[2].grains == std::vector<Index>{9, 10});
  CHECK(found.networks[2].mean_force == -0.5);
}

TEST_CASE("equal networks keep a stable order: more contacts first, then the smaller grain") {
  const auto bed = hand_made({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 0, 0}, {10, 0, 0}, {9, 1, 0}},
                             {{0, 1, 1}, {1, 2, 1}, {3, 4, 1}, {4, 5, 1}, {5, 3, 1}});
  const auto networks = force_networks(bed).networks;
  REQUIRE(networks.size() == 2);
  CHECK(networks[0].grains.front() == 3);
  CHECK(networks[1].grains.front() == 0);
}

TEST_CASE("the extent is the largest of all distances") {
  Random random(21);
  const auto shape = GENERATE(as<std::string>{}, "box", "shell", "column", "lattice", "far apart");
  for (const std::size_t count : {2, 3, 15, 16, 17, 200, 1500}) {
    std::vector<Point> points;
    while (points.size() < count) {
      Point p{uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5};
      if (shape == "shell") {
        const double r = distance(p, {0, 0, 0});
        for (double& x : p) x /= r;
      }
      if (shape == "column") p[2] *= 60;
      if (shape == "lattice") {
        for (double& x : p) x = std::floor(8 * x);
      }
      if (shape == "far apart" && points.size() % 3 == 0) p[0] += 1e4;
      points.push_back(p);
    }
    INFO(shape << " of " << count);
    CHECK(extent(points) == brute_extent(points));
  }
  CHECK(extent(std::vector<Point>{}) == 0);
  CHECK(extent(std::vector<Point>{{1, 2, 3}}) == 0);
}

TEST_CASE("networks of a bed of Sun's size") {
  const auto bed = packing({}, 22);
  const auto found = force_networks(bed);
  REQUIRE(!found.networks.empty());
  const auto& largest = found.networks.front();
  std::vector<Point> centres;
  for (const Index grain : largest.grains) centres.push_back(bed.position[grain]);
  CHECK(largest.grains.size() > 7000);
  CHECK(largest.extent == brute_extent(centres));
  std::size_t contacts = 0, grains = 0;
  for (const auto& network : found.networks) {
    contacts += network.contacts.size();
    grains += network.grains.size();
    CHECK(network.contacts.size() + 1 >= network.grains.size());
  }
  CHECK(contacts == bed.contacts.size());
  CHECK(grains <= bed.grains());
}
