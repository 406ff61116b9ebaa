#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <future>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "simulator/scene/read_scene.hpp"
#include "simulator/simulate.hpp"
#include "tests/oracle/lammps.hpp"

// The reduced bed of Sun 2006 as a statistical ensemble: ours, packed by shaking, against the deck
// that `shakebed export` writes, whose grains fall and relax in LAMMPS. Coordination number and
// height of the centre of mass at 20 phases of a cycle, averaged over cycles 2 to 8, and the large
// grain's rise per cycle, each within 3 combined standard errors, which come from independent
// seeds.
//
// False alarms: two ensembles of one bed differ by more than 3 combined standard errors of 6 and 8
// seeds in about 1 % of quantities; in one of these 41, which are correlated, in a share of all
// choices of seeds that the test estimates by dealing the 14 beds to two sides in all ways that
// keep 6 and 8, and prints: 28 %. The seeds are fixed: on one machine the verdict repeats.
namespace {

using namespace shakebed;

constexpr int phases = 20;
constexpr long first_cycle = 2;
constexpr long last_cycle = 8;
constexpr double margin = 3;  // combined standard errors
constexpr std::size_t their_beds = 6;
constexpr std::size_t our_beds = 8;

simulator::Scene reduced_bed() {
  return simulator::read_scene(SHAKEBED_SCENES "/brazil_nut.yaml",
                               {{"grains.count", "400"},
                                {"grains.large", "{diameter: 2, density: 13.54}"},
                                {"container.cylinder.diameter", "5"},
                                {"protocol.measure.cycles", std::to_string(last_cycle)}});
}

/// What is compared of one bed, by name.
using Numbers = std::map<std::string, double>;

/// Series sampled at `phases` instants of a cycle from T = 0 on.
Numbers numbers_of(std::map<std::string, std::vector<double>> series) {
  Numbers numbers;
  const double cycles = last_cycle - first_cycle;
  for (int phase = 0; phase < phases; ++phase) {
    for (const char* name : {"coordination", "small_height"}) {
      double sum = 0;
      for (long cycle = first_cycle; cycle < last_cycle; ++cycle) {
        sum += series.at(name).at(static_cast<std::size_t>(cycle * phases + phase));
      }
      char label[60];
      std::snprintf(label, sizeof label, "%s at phase %.2f", name, phase / double{phases});
      numbers[label] = sum / cycles;
    }
  }
  const auto& large = series.at("large_height");
  numbers["rise per cycle"] = (large.at(static_cast<std::size_t>((last_cycle - 1) * phases)) -
                               large.at(static_cast<std::size_t>(first_cycle * phases))) /
                              (cycles - 1);
  return numbers;
}

Numbers our_bed(simulator::Scene scene, std::uint64_t seed) {
  scene.seed = seed;
  const auto record = simulator::simulate(scene);
  std::map<std::string, std::vector<double>> series;
  for (const auto& one : record.series) {
    const std::size_t stride = one.values.size() / (last_cycle * phases);
    for (std::size_t k = 0; k < one.values.size(); k += stride) {
      series[one.name].push_back(one.values[k]);
    }
  }
  return numbers_of(series);
}

Numbers their_bed(const simulator::Scene& scene, std::uint64_t seed) {
  auto rows = tests::run_lammps_column(scene, seed);
  // The base starts at its lowest, a quarter of a cycle before T = 0.
  const auto& T = rows.at("T");
  const auto begin =
      std::find_if(T.begin(), T.end(), [](double t) { return t > -0.5 / phases; }) - T.begin();
  std::map<std::string, std::vector<double>> series;
  for (auto& [name, values] : rows) series[name] = {values.begin() + begin, values.end()};
  CHECK(std::abs(series.at("T").front()) < 1e-9);
  return numbers_of(series);
}

/// Two at a time.
template <class Bed>
std::vector<Numbers> ensemble(std::size_t count, std::uint64_t first_seed, const Bed& bed) {
  std::vector<Numbers> beds;
  for (std::size_t k = 0; k < count; k += 2) {
    auto other = std::async(std::launch::async, bed, first_seed + k + 1);
    beds.push_back(bed(first_seed + k));
    beds.push_back(other.get());
  }
  return beds;
}

struct MeanOf {
  double mean = 0;
  double standard_error = 0;
};

MeanOf mean_of(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double square = 0;
  for (const double v : values) square += (v - mean) * (v - mean);
  return {mean, std::sqrt(square / (n - 1) / n)};
}

/// Their difference in combined standard errors.
double apart(const MeanOf& a, const MeanOf& b) {
  return (a.mean - b.mean) / std::hypot(a.standard_error, b.standard_error);
}

/// One quantity of the beds that are, or are not, marked.
std::vector<double> column(const std::vector<Numbers>& beds, const std::vector<bool>& marked,
                           bool mark, const std::string& name) {
  std::vector<double> values;
  for (std::size_t k = 0; k < beds.size(); ++k) {
    if (marked[k] == mark) values.push_back(beds[k].at(name));
  }
  return values;
}

/// Share of deals of the beds to two sides in which some quantity alarms.
double false_alarm_rate(const std::vector<Numbers>& beds, std::size_t marks) {
  std::vector<bool> marked(beds.size(), false);
  std::fill(marked.end() - static_cast<std::ptrdiff_t>(marks), marked.end(), true);
  long deals = 0;
  long alarms = 0;
  do {
    ++deals;
    alarms += std::any_of(beds.front().begin(), beds.front().end(), [&](const auto& one) {
      return std::abs(apart(mean_of(column(beds, marked, false, one.first)),
                            mean_of(column(beds, marked, true, one.first)))) > margin;
    });
  } while (std::next_permutation(marked.begin(), marked.end()));
  return static_cast<double>(alarms) / static_cast<double>(deals);
}

}  // namespace

TEST_CASE("The reduced bed of Sun 2006 has LAMMPS' coordination, centre of mass and rise",
          "[statistics]") {
  if (!tests::lammps_is_here()) {
    WARN("oracle skipped: no program lmp with the package GRANULAR on PATH");
    return;
  }
  const auto scene = reduced_bed();
  auto beds = ensemble(our_beds, 1, [&](std::uint64_t seed) { return our_bed(scene, seed); });
  const auto theirs =
      ensemble(their_beds, 101, [&](std::uint64_t seed) { return their_bed(scene, seed); });
  beds.insert(beds.end(), theirs.begin(), theirs.end());
  std::vector<bool> is_theirs(beds.size(), false);
  std::fill(is_theirs.begin() + static_cast<std::ptrdiff_t>(our_beds), is_theirs.end(), true);
  for (const auto& [name, unused] : beds.front()) {
    const auto a = mean_of(column(beds, is_theirs, false, name));
    const auto b = mean_of(column(beds, is_theirs, true, name));
    std::printf("%-28s shakebed %.4f +- %.4f  LAMMPS %.4f +- %.4f  %+.2f se\n", name.c_str(),
                a.mean, a.standard_error, b.mean, b.standard_error, apart(a, b));
    INFO(name);
    CHECK(std::abs(apart(a, b)) <= margin);
  }
  // The power: a rise is seen, and known to a quarter of itself or better.
  const auto rise = mean_of(column(beds, is_theirs, false, "rise per cycle"));
  CHECK(rise.standard_error < 0.25 * rise.mean);
  std::printf("false alarms of all 41 together: %.1f %% of deals\n",
              100 * false_alarm_rate(beds, their_beds));
}
