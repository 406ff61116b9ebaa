#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <set>

#include "simulator/motion/column/promise.hpp"

// Who is listed: pairs within a skin against all pairs looked at, and pairs that may meet against
// the worst that two grains can do within their promises.
namespace {

using namespace shakebed::simulator;
using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

/// Grains of radii 0.45 to 0.55 and one of 1.58, anywhere in a cylinder of radius 5 (overlapping
/// freely: the search does not mind), some a little outside of it.
SizedGrains scattered(std::size_t n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> across(-5.05, 5.05), up(0, 12), size(0.45, 0.55);
  SizedGrains grains;
  grains.resize_to(n);
  for (std::size_t i = 0; i < n; ++i) {
    grains.position[0][i] = across(random);
    grains.position[1][i] = across(random);
    grains.position[2][i] = up(random);
    grains.radius[i] = i == n / 3 ? 1.58 : size(random);
  }
  return grains;
}

Pairs all_within(const RowStore& rows, double skin) {
  Pairs found;
  for (std::uint32_t i = 0; i < rows.count(); ++i) {
    for (std::uint32_t j = i + 1; j < rows.count(); ++j) {
      const Four r = rows.position[i] - rows.position[j];
      const double reach = rows.radius[i] + rows.radius[j] + skin;
      if (r[0] * r[0] + r[1] * r[1] + r[2] * r[2] < reach * reach) found.emplace(i, j);
    }
  }
  return found;
}

TEST_CASE("the outer list holds every pair within its skin once") {
  for (const double skin : {0.05, 0.5, 1.5, 5.0}) {
    for (const std::size_t n : {1, 2, 9, 900, 1700}) {
      CAPTURE(skin, n);
      RowStore rows(scattered(n, 11));
      rows.reorder(rows.by_height());
      OuterList list(5, BlockCuts(n));
      list.build(rows, skin);
      Pairs found;
      for (std::size_t k = 0; k < list.size(); ++k) {
        const auto [i, j] = std::minmax(list.i()[k], list.j()[k]);
        CHECK(found.emplace(i, j).second);
        CHECK(list.contact_size()[k] == rows.radius[i] + rows.radius[j]);
      }
      CHECK(found == all_within(rows, skin));
      std::size_t shares = 0;
      for (std::uint32_t i = 0; i < n; ++i) {
        list.for_pairs_of(i, [&](std::uint32_t k) {
          shares += list.i()[k] == i || list.j()[k] == i ? 1 : 1000000;
        });
      }
      CHECK(shares == 2 * list.size());
    }
  }
}

/// Least |r + w t| - size - width t over [0, left], at so many times.
double least_gap(const Triple<double>& r, const Triple<double>& w, double size, double width,
                 double left) {
  constexpr int times = 20000;
  double least = 1e300;
  for (int k = 0; k <= times; ++k) {
    const double t = left * k / times;
    const Triple<double> x = r + t * w;
    least = std::min(least, std::sqrt(dot(x, x)) - size - width * t);
  }
  return least;
}

TEST_CASE("pairs that may meet are those whose promises let them") {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  int met = 0;
  int decided = 0;
  for (int k = 0; k < 2000; ++k) {
    const double left = 0.0066;
    const double size = 0.9 + uniform(random);
    const double width = std::pow(10, -3 + 4 * uniform(random));
    Triple<double> n{normal(random), normal(random), normal(random)};
    n = (1 / std::sqrt(dot(n, n))) * n;
    // Half of them from nearer than a tenth of what they can cover.
    const double speed = std::pow(10, -2 + 4 * uniform(random));
    const Triple<double> r = (size + 2 * uniform(random) * (speed + width) * left) * n;
    const Triple<double> w = speed * Triple<double>{normal(random), normal(random), normal(random)};
    const double gap = least_gap(r, w, size, width, left);
    const bool may = may_meet(dot(r, r), dot(r, w), dot(w, w), size, width, left);
    // It may list a pair that just misses: sizes are taken 1e-9 larger, widths 1.001 times.
    const double slack = 2e-3 * width * left + 1e-8;
    if (gap < -1e-12) CHECK(may);
    if (gap > slack) CHECK_FALSE(may);
    met += may;
    decided += gap < -1e-12 || gap > slack;
  }
  CHECK(decided > 1900);
  CHECK(met > 300);
  CHECK(met < 1700);
}

}  // namespace
