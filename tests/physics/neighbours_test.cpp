// The list of neighbours against every pair of grains, looked at one by one.
#include <catch2/catch.hpp>
#include <map>
#include <utility>

#include "simulator/grains/random_stream.hpp"
#include "tests/physics/impact.hpp"

namespace shakebed::tests {
namespace {

using PairMap = std::map<std::pair<std::uint32_t, std::uint32_t>, double>;

/// Squared separation by nearest image, from the definition: the least over the images around.
template <int D>
double nearest_separation_squared(const simulator::PeriodicCell<D>& cell, Vector<D> r) {
  for (int c = 0; c < D - 1; ++c) {
    double least = std::abs(r[c]);
    for (int image = -9; image <= 9; ++image) {
      least = std::min(least, std::abs(r[c] + image * cell.width[c]));
    }
    r[c] = least;
  }
  return r.squaredNorm();
}

template <int D>
PairMap every_pair_within(const simulator::PeriodicCell<D>& cell,
                          const simulator::Columns<D>& position, double reach) {
  PairMap found;
  const auto n = static_cast<std::uint32_t>(position[0].size());
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = i + 1; j < n; ++j) {
      const double r2 = nearest_separation_squared<D>(cell, row(position, j) - row(position, i));
      if (r2 <= reach * reach) found[{i, j}] = r2;
    }
  }
  return found;
}

template <int D>
double listed_separation_squared(const simulator::NeighbourPair<D>& pair,
                                 const simulator::Columns<D>& position) {
  Vector<D> r = row(position, pair.j) - row(position, pair.i);
  for (int c = 0; c < D - 1; ++c) r[c] += pair.shift[c];
  return r.squaredNorm();
}

template <int D>
void compare(const simulator::PeriodicCell<D>& cell, const simulator::Columns<D>& position,
             double reach, simulator::NeighbourSearch<D>& search) {
  std::vector<simulator::NeighbourPair<D>> pairs;
  search.find(position, reach, pairs);
  PairMap listed;
  for (const auto& pair : pairs) {
    listed[{std::min(pair.i, pair.j), std::max(pair.i, pair.j)}] =
        listed_separation_squared<D>(pair, position);
  }
  const auto all = every_pair_within<D>(cell, position, reach);
  REQUIRE(listed.size() == pairs.size());  // each pair once
  REQUIRE(listed.size() == all.size());
  for (const auto& [pair, r2] : all) {
    REQUIRE(listed.count(pair) == 1);
    REQUIRE(listed[pair] == Approx(r2).epsilon(1e-12));
  }
}

template <int D>
std::vector<simulator::PeriodicCell<D>> cells() {
  if constexpr (D == 2) return {{{2.2}}, {{5}}, {{11.7}}, {{60}}};
  if constexpr (D == 3) return {{{2.2, 2.2}}, {{5, 5}}, {{2.2, 14}}, {{9, 4.4}}, {{17, 13}}};
}

/// Unwrapped positions (grains that have gone round the cell), a column with a sparse top.
template <int D>
simulator::Columns<D> random_positions(const simulator::PeriodicCell<D>& cell, std::size_t count,
                                       simulator::RandomStream& random) {
  simulator::Columns<D> position;
  simulator::resize(position, count);
  const double depth = 3 * static_cast<double>(count) / cell.area();
  for (std::size_t i = 0; i < count; ++i) {
    for (int c = 0; c < D - 1; ++c) position[c][i] = cell.width[c] * (8 * random.uniform() - 4);
    position[D - 1][i] = -1 - depth * std::log(random.uniform());
  }
  return position;
}

/// Every overlapping pair of grains, as the list must know it.
template <class Stepper>
void require_overlaps_listed(Stepper& stepper, const simulator::PeriodicCell<Stepper::D>& cell) {
  constexpr int D = Stepper::D;
  const auto& position = stepper.synchronised().position;
  std::size_t listed = 0;
  for (const auto& pair : stepper.neighbour_pairs()) {
    listed += listed_separation_squared<D>(pair, position) < 1;
  }
  std::size_t overlapping = 0;
  const auto n = static_cast<std::uint32_t>(position[0].size());
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = i + 1; j < n; ++j) {
      Vector<D> r = row(position, j) - row(position, i);
      if (std::abs(r[D - 1]) >= 1) continue;
      for (int c = 0; c < D - 1; ++c) r[c] += cell.image_shift(c, r[c]);
      overlapping += r.squaredNorm() < 1;
    }
  }
  REQUIRE(listed == overlapping);
}

template <int D>
simulator::Scene rough_bed(std::vector<double> cell, int count, double V_p) {
  simulator::Scene scene;
  scene.dimension = D;
  scene.cell = std::move(cell);
  scene.grains = {count, count / scene.cell_area(), 0.9, 0.4};
  scene.base = {{1, V_p}, 0.9, 0.4};
  scene.contact.tangential = simulator::TangentialLaw::viscous_coulomb;
  scene.protocol.time_step_fraction = 0.1;
  return scene;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("neighbours: the search finds what looking at every pair finds", "",
                       ((int D), D), 2, 3) {
  simulator::RandomStream random(11, simulator::RandomPurpose::filling);
  for (const auto& cell : cells<D>()) {
    simulator::NeighbourSearch<D> search(cell);
    for (const std::size_t count : {1, 2, 40, 250}) {
      for (const double reach : {1.0, 1.05, 1.1, 1.5, 2.0, 2.5, 5.0}) {
        if (reach > 0.5 * cell.narrowest()) continue;
        INFO("cell " << cell.width[0] << ", " << count << " grains, reach " << reach);
        compare<D>(cell, random_positions<D>(cell, count, random), reach, search);
      }
    }
  }
}

// Grains exactly on a border of the cell or of a strip belong somewhere, once.
TEST_CASE("neighbours: grains on the borders of strips are found") {
  const simulator::PeriodicCell<3> cell{{6, 6}};
  simulator::NeighbourSearch<3> search(cell);
  simulator::Columns<3> position;
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 12; ++j) {
      position[0].push_back(0.5 * i);
      position[1].push_back(6 - 0.5 * j);
      position[2].push_back(0.25 * (i % 3));
    }
  }
  position[0][5] = std::nextafter(6, 0);
  position[0][7] = -1e-17;  // wraps to the width itself
  compare<3>(cell, position, 1.2, search);
}

// No contact is ever lost while a list is in use, neither in a cell so narrow that the skin is
// only 0.1 d, nor in a wide one, nor when the base strikes at ten times the grains' speed.
TEST_CASE("neighbours: a running bed's list knows every overlap at every step") {
  const auto watch = [](auto dimension, const simulator::Scene& scene, long every, long looks) {
    constexpr int D = decltype(dimension)::value;
    const auto physics =
        simulator::bind_physics<Rough<D>>(scene, simulator::bind_parameters(scene));
    simulator::UniformStepper<Rough<D>> stepper(physics,
                                                simulator::settle<Rough<D>>(scene, {}).grains);
    for (long k = 0; k < looks; ++k) {
      stepper.advance(every);
      require_overlaps_listed(stepper, physics.cell);
    }
    CHECK(stepper.ledger().collisions > 5 * scene.grains.count);
  };
  watch(std::integral_constant<int, 2>{}, rough_bed<2>({2.2}, 8, 4.7), 1, 60000);
  watch(std::integral_constant<int, 2>{}, rough_bed<2>({20}, 60, 9.4), 1, 20000);
  watch(std::integral_constant<int, 3>{}, rough_bed<3>({2.2, 2.2}, 12, 4.7), 1, 40000);
  watch(std::integral_constant<int, 3>{}, rough_bed<3>({5, 5}, 100, 4.7), 4, 12000);
  watch(std::integral_constant<int, 3>{}, rough_bed<3>({8, 5}, 80, 2), 4, 8000);
}

// A bed may start with grains faster than its base ever was.
TEST_CASE("neighbours: a fast start is in the first list") {
  const double dt = contact_duration({2e4, 1}, Partner::grain) / 25;
  const auto physics = still_world<Smooth<2>>({2e4, 1}, 1, dt);
  auto start = simulator::fill<2, false>(12, physics.cell, 5);
  for (std::size_t i = 0; i < 12; ++i) start.velocity[0][i] = i % 2 == 0 ? 5 : -5;
  simulator::UniformStepper<Smooth<2>> stepper(physics, start);
  for (int step = 0; step < 300; ++step) {
    stepper.advance(1);
    require_overlaps_listed(stepper, physics.cell);
  }
  CHECK(stepper.ledger().collisions > 5);
}

}  // namespace shakebed::tests
