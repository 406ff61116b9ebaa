#include "simulator/grains/random_stream.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

namespace shakebed::tests {

using simulator::RandomPurpose;
using simulator::RandomStream;

// Random123's published known answer for philox4x32-10 with counter 0 and key 0: 6627e8d5 e169c58d
// bc57ac4c 9b00dbd8 (Salmon et al., SC'11, and the file kat_vectors). The first 52 bits make the
// number.
TEST_CASE("random stream: Philox's known answer") {
  RandomStream random(0, static_cast<RandomPurpose>(0));
  CHECK(random.uniform() == (static_cast<double>(0x6627e8d5e169cULL) + 0.5) * 0x1p-52);
}

TEST_CASE("random stream: the same again, other seeds and purposes are others") {
  RandomStream a(7, RandomPurpose::filling);
  RandomStream same(7, RandomPurpose::filling);
  RandomStream other_seed(8, RandomPurpose::filling);
  RandomStream high_seed(7 + (1ULL << 32), RandomPurpose::filling);
  RandomStream other_purpose(7, RandomPurpose::thermal_velocities);
  for (int k = 0; k < 100; ++k) {
    const double x = a.uniform();
    CHECK(x == same.uniform());
    CHECK(x != other_seed.uniform());
    CHECK(x != high_seed.uniform());
    CHECK(x != other_purpose.uniform());
  }
}

// Kolmogorov-Smirnov: sqrt(n) D > 2.23 with probability 2 exp(-2 x 2.23^2) = 1e-4.
TEST_CASE("random stream: uniform in (0, 1)") {
  RandomStream random(1, RandomPurpose::filling);
  std::vector<double> x(100000);
  for (double& value : x) value = random.uniform();
  std::sort(x.begin(), x.end());
  CHECK(x.front() > 0);
  CHECK(x.back() < 1);
  const auto n = static_cast<double>(x.size());
  double D = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const auto rank = static_cast<double>(k);
    D = std::max({D, x[k] - rank / n, (rank + 1) / n - x[k]});
  }
  CHECK(std::sqrt(n) * D < 2.23);
}

// Moments of n normal numbers: mean 0 +- 1/sqrt(n), variance 1 +- sqrt(2/n), <x^3> 0 +- sqrt(15/n),
// <x^4> 3 +- sqrt(96/n), successive product 0 +- 1/sqrt(n). Five comparisons at 4 standard errors:
// false alarm 5 x 6e-5.
TEST_CASE("random stream: normal numbers have a normal's moments") {
  RandomStream random(2, RandomPurpose::thermal_velocities);
  constexpr int count = 1000000;
  double m1 = 0, m2 = 0, m3 = 0, m4 = 0, product = 0, last = 0;
  for (int k = 0; k < count; ++k) {
    const double x = random.normal();
    m1 += x / count;
    m2 += x * x / count;
    m3 += x * x * x / count;
    m4 += x * x * x * x / count;
    product += x * last / count;
    last = x;
  }
  const double root = std::sqrt(1.0 / count);
  CHECK(std::abs(m1) < 4 * root);
  CHECK(std::abs(m2 - 1) < 4 * std::sqrt(2.0) * root);
  CHECK(std::abs(m3) < 4 * std::sqrt(15.0) * root);
  CHECK(std::abs(m4 - 3) < 4 * std::sqrt(96.0) * root);
  CHECK(std::abs(product) < 4 * root);
}

}  // namespace shakebed::tests
