#include "fitting/trade/bias_law.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/fitting/table3.hpp"

namespace {

using namespace shakebed;
using namespace shakebed::fitting;
using files::number_text;

/// Two scenes with T_z = 2 (1 + c_dt (dt/t_c)^2) and 2 (1 + c_k (k_n)^(-1/2)), 0.3 % noise.
files::CsvTable table_with(double c_dt, double c_k, double noise, unsigned long seed,
                           double W_of_second = 20) {
  const auto random = random_stream(seed);
  files::CsvTable table({{"scene", ""},
                         {"axis", ""},
                         {"value", "1"},
                         {"W", "1"},
                         {"T_z", "m g d"},
                         {"T_z_se", "m g d"},
                         {"seconds_per_1000_cycles", "s"}});
  const auto add = [&](const std::string& scene, const char* axis, double value, double T_z,
                       double cost) {
    const std::string W = number_text(scene == "first" ? 10 : W_of_second);
    const double noisy = T_z + gsl_ran_gaussian(random.get(), noise * T_z);
    table.add_row({scene, axis, number_text(value), W, number_text(noisy),
                   number_text(std::max(noise, 1e-9) * T_z), number_text(cost)});
  };
  for (const char* scene : {"first", "second"}) {
    add(scene, "reference", 50, 2, 4);
    for (const double n : {5.0, 7.0, 10.0, 14.0, 20.0, 50.0}) {
      add(scene, "dt closed", n, 2 * (1 + c_dt / (n * n)), 2);
    }
    for (const double k : {0.1, 0.3, 1.0, 3.0, 10.0, 30.0}) {
      add(scene, "k_n", k, 2 * (1 + c_k / std::sqrt(k)), 1);
    }
  }
  return table;
}

TEST_CASE("Without noise the laws are found exactly") {
  const auto table = table_with(-1.5, 0.02, 0, 1);
  for (const auto& law : trade::bias_laws(table, "dt closed")) {
    CHECK(law.coefficient == Approx(-1.5).epsilon(1e-6));
  }
  for (const auto& law : trade::bias_laws(table, "k_n")) {
    CHECK(law.coefficient == Approx(0.02).epsilon(1e-6));
  }
}

TEST_CASE("With noise they are within five of their standard errors, which are honest") {
  // 40 laws; 5 sigma: false alarm 40 * 6e-7. Mean square of 40 standard normals: 1 +- 0.22, so
  // [0.3, 2.1] alarms at 5e-4 (errors are enlarged where chi^2 is large, which lowers it).
  double square = 0;
  int laws = 0;
  for (unsigned long seed = 1; seed <= 20; ++seed) {
    for (const auto& law : trade::bias_laws(table_with(-1.5, 0.02, 0.003, seed), "dt closed")) {
      const double z = (law.coefficient + 1.5) / law.error;
      CHECK(std::abs(z) < 5);
      square += z * z;
      ++laws;
    }
  }
  REQUIRE(laws == 40);
  CHECK(square / laws > 0.3);
  CHECK(square / laws < 2.1);
}

TEST_CASE("The bound is that of the worst scene, and covers its error") {
  const std::vector<trade::BiasLaw> laws{{"a", "k_n", 0.02, 0.001, 1, 3, {}},
                                         {"b", "k_n", -0.01, 0.01, 1, 3, {}}};
  CHECK(trade::bias_bound(laws) == Approx(0.01 + 1.64 * 0.01));
}

TEST_CASE("The table of settings has bounds that follow the laws, and relative costs") {
  const auto table = trade::accuracy_table(table_with(-1.5, 0.02, 0, 1));
  const auto row_of = [&](const std::string& axis, double value) {
    for (std::size_t row = 0; row < table.rows(); ++row) {
      if (table.text(row, 0) == axis && table.number(row, 1) == value) return row;
    }
    FAIL("no row for " << axis << " " << value);
    return std::size_t{0};
  };
  CHECK(table.number(row_of("dt closed", 10), 2) == Approx(1.5).epsilon(1e-4));
  CHECK(table.number(row_of("dt closed", 10), 3) == Approx(0.5));
  CHECK(table.number(row_of("k_n", 0.1), 2) == Approx(2 / std::sqrt(0.1)).epsilon(1e-4));
  CHECK(table.number(row_of("k_n", 30), 3) == Approx(0.25));
}

TEST_CASE("Scenes near the onset bound nothing, as nothing is promised there") {
  const auto scenes = [](double W_of_second) {
    const auto table = trade::accuracy_table(table_with(-1.5, 0.02, 0, 1, W_of_second));
    return table.number(0, table.column("scenes"));
  };
  CHECK(scenes(5) == 2);
  CHECK(scenes(4.9) == 1);
}

}  // namespace
