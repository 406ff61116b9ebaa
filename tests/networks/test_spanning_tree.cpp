#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "files/error.hpp"
#include "fitting/networks/spanning_tree.hpp"
#include "tests/networks/oracle.hpp"
#include "tests/networks/packing.hpp"

using namespace shakebed::tests;
using shakebed::fitting::networks::spanning_trees;
using shakebed::fitting::networks::TreeEdge;

namespace {

std::vector<Point> uniform_points(std::size_t count, Random& random) {
  std::vector<Point> points;
  while (points.size() < count)
    points.push_back({uniform(random), uniform(random), uniform(random)});
  return points;
}

std::vector<Point> clusters(std::size_t count, Random& random) {
  std::vector<Point> points;
  while (points.size() < count) {
    const double x = std::floor(4 * uniform(random)) * 25,
                 scale = std::pow(10, -2 * uniform(random));
    points.push_back(
        {x + scale * uniform(random), scale * uniform(random), scale * uniform(random)});
  }
  return points;
}

std::vector<Point> lattice(int side) {
  std::vector<Point> points;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (int z = 0; z < side; ++z) points.push_back({1.0 * x, 1.0 * y, 1.0 * z});
    }
  }
  return points;
}

void check_against_prim(const std::vector<Point>& points, int passes, double elongation) {
  const auto trees = spanning_trees(points, passes, elongation);
  REQUIRE(trees.size() == static_cast<std::size_t>(passes));
  DensePasses prim(points, elongation);
  for (const auto& tree : trees) {
    REQUIRE(tree.size() + 1 == points.size());
    REQUIRE(edges(tree) == prim.next());
    for (const auto& edge : tree) {
      REQUIRE(edge.length == std::sqrt(square(points[edge.i], points[edge.j])));
    }
  }
}

/// Least sum of weights over all n^(n-2) labelled trees, by their Pruefer sequences.
double least_sum(const std::vector<std::vector<double>>& weight) {
  const std::size_t n = weight.size();
  if (n == 2) return weight[0][1];
  std::vector<std::size_t> sequence(n - 2, 0);
  double least = std::numeric_limits<double>::infinity();
  for (;;) {
    std::vector<int> degree(n, 1);
    for (const std::size_t node : sequence) ++degree[node];
    double sum = 0;
    for (const std::size_t node : sequence) {
      const auto leaf = static_cast<std::size_t>(std::ranges::find(degree, 1) - degree.begin());
      sum += weight[leaf][node];
      --degree[leaf];
      --degree[node];
    }
    const auto one = std::ranges::find(degree, 1);
    const auto other = std::find(one + 1, degree.end(), 1);
    least = std::min(least, sum + weight[static_cast<std::size_t>(one - degree.begin())]
                                        [static_cast<std::size_t>(other - degree.begin())]);
    std::size_t digit = 0;
    while (digit < sequence.size() && ++sequence[digit] == n) sequence[digit++] = 0;
    if (digit == sequence.size()) return least;
  }
}

}  // namespace

TEST_CASE("no spanning tree of a few points is shorter") {
  Random random(11);
  for (std::size_t n = 2; n <= 7; ++n) {
    for (int draw_number = 0; draw_number < 6; ++draw_number) {
      const auto points = uniform_points(n, random);
      const double elongation = draw_number % 2 == 0 ? 1.2 : 3.0;
      EdgeSet taken;
      for (const auto& tree : spanning_trees(points, 4, elongation)) {
        std::vector<std::vector<double>> weight(n, std::vector<double>(n));
        for (Index i = 0; i < n; ++i) {
          for (Index j = 0; j < n; ++j) {
            const bool before = taken.contains({std::min(i, j), std::max(i, j)});
            weight[i][j] = std::sqrt(square(points[i], points[j])) * (before ? elongation : 1);
          }
        }
        double sum = 0;
        for (const auto& edge : tree) sum += weight[edge.i][edge.j];
        REQUIRE(tree.size() + 1 == n);
        REQUIRE(sum == Approx(least_sum(weight)).epsilon(1e-12));
        for (const auto& edge : tree) taken.emplace(edge.i, edge.j);
      }
    }
  }
}

TEST_CASE("every pass is the tree that Prim finds on all pairs") {
  Random random(12);
  const double elongation = GENERATE(1.0, 1.05, 1.2, 5.0);
  SECTION("random") { check_against_prim(uniform_points(400, random), 5, elongation); }
  SECTION("clustered, 25 apart") { check_against_prim(clusters(400, random), 5, elongation); }
  SECTION("lattice, rich in ties") { check_against_prim(lattice(6), 5, elongation); }
  SECTION("a line") {
    auto points = uniform_points(150, random);
    for (auto& point : points) point[1] = point[2] = 0;
    check_against_prim(points, 4, elongation);
  }
  SECTION("points that coincide") {
    auto points = uniform_points(60, random);
    for (std::size_t k = 0; k < 30; ++k) points.push_back(points[k % 7]);
    check_against_prim(points, 4, elongation);
  }
  SECTION("two beds and grains far above") {
    auto points = uniform_points(300, random);
    for (std::size_t k = 0; k < 150; ++k) points[k][2] += 12;
    for (std::size_t k = 0; k < 5; ++k) points[k][2] += 30 + 9 * static_cast<double>(k * k);
    check_against_prim(points, 5, elongation);
  }
}

TEST_CASE("a bed of Sun's size with flying grains agrees with Prim on all 28 million pairs") {
  const auto bed = packing({.flying = 4}, 13);
  check_against_prim(bed.position, 3, 1.2);
}

TEST_CASE("trees of few points") {
  CHECK(spanning_trees(std::vector<Point>{}, 2, 1.2) == std::vector<SpanningTree>(2));
  CHECK(spanning_trees(std::vector<Point>{{1, 2, 3}}, 2, 1.2) == std::vector<SpanningTree>(2));
  const auto pair = spanning_trees(std::vector<Point>{{0, 0, 0}, {0, 3, 4}}, 2, 1.2);
  CHECK(pair == std::vector<SpanningTree>(2, {TreeEdge{0, 1, 5.0}}));
}

TEST_CASE("an edge taken twice is elongated once") {
  // A triangle of sides 1, 1.1 and 1.25: pass 2 leaves 1.1 * 1.2 for 1.25 and keeps 1 * 1.2. Pass 3
  // has 1.2, 1.32 and 1.5; with 1 elongated twice (1.44) it would be the same two, but at a fourth
  // pass 1.728 would lose to 1.5.
  const double x = (1 + 1.25 * 1.25 - 1.1 * 1.1) / 2;
  const std::vector<Point> points{{0, 0, 0}, {1, 0, 0}, {x, std::sqrt(1.25 * 1.25 - x * x), 0}};
  const auto trees = spanning_trees(points, 4, 1.2);
  const EdgeSet short_ones{{0, 1}, {1, 2}}, other{{0, 1}, {0, 2}};
  CHECK(edges(trees[0]) == short_ones);
  CHECK(edges(trees[1]) == other);
  CHECK(edges(trees[2]) == short_ones);
  CHECK(edges(trees[3]) == short_ones);
}

TEST_CASE("trees do not depend on the order of the points, nor on where and how the bed lies") {
  Random random(14);
  const auto points = uniform_points(500, random);
  const auto expected = spanning_trees(points, 4, 1.2);

  std::vector<Index> order(points.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::shuffle(order.begin(), order.end(), random);
  std::vector<Point> shuffled, moved;
  for (const Index k : order) shuffled.push_back(points[k]);
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (const auto& [x, y, z] : points) {
    const double u = c * x - s * y, v = s * x + c * y;
    moved.push_back({u + 17, c * v - s * z - 4, s * v + c * z + 250});
  }
  const auto of_shuffled = spanning_trees(shuffled, 4, 1.2);
  const auto of_moved = spanning_trees(moved, 4, 1.2);
  for (std::size_t pass = 0; pass < expected.size(); ++pass) {
    EdgeSet back;
    for (const auto& edge : of_shuffled[pass]) {
      back.emplace(std::min(order[edge.i], order[edge.j]), std::max(order[edge.i], order[edge.j]));
    }
    CHECK(back == edges(expected[pass]));
    CHECK(edges(of_moved[pass]) == edges(expected[pass]));
  }
}

TEST_CASE("passes and elongations that make no sense are refused") {
  const std::vector<Point> points{{0, 0, 0}, {1, 0, 0}};
  using shakebed::files::Error;
  CHECK_THROWS_AS(spanning_trees(points, 0, 1.2), Error);
  CHECK_THROWS_AS(spanning_trees(points, 1, 0.9), Error);
  CHECK_THROWS_AS(spanning_trees(points, 1, std::nan("")), Error);
  CHECK_THROWS_AS(spanning_trees(points, 1, std::numeric_limits<double>::infinity()), Error);
}
