#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "simulator/column_preparation.hpp"
#include "simulator/contact/cundall_strack.hpp"
#include "simulator/contact/linear_overlap.hpp"
#include "simulator/observables/column_series.hpp"
#include "simulator/simulate.hpp"
#include "tests/column/physics.hpp"
#include "tests/column/scene_text.hpp"

namespace {

using namespace shakebed;
using tests::small_column;

/// Keeps beds in memory and counts.
struct MemoryStore {
  std::map<std::string, std::string> beds;
  int loads = 0;
  int saves = 0;

  simulator::BedStore store() {
    return {[this](const std::string& name) -> std::optional<std::string> {
              const auto found = beds.find(name);
              if (found == beds.end()) return std::nullopt;
              ++loads;
              return found->second;
            },
            [this](const std::string& name, const std::string& bytes) {
              beds[name] = bytes;
              ++saves;
            },
            [this](const std::string& name) { beds.erase(name); }};
  }
};

const std::vector<double>& series_of(const simulator::Record& record, const std::string& name) {
  for (const auto& one : record.series) {
    if (one.name == name) return one.values;
  }
  throw std::runtime_error("no series " + name);
}

double scalar_of(const simulator::Record& record, const std::string& name) {
  for (const auto& one : record.scalars) {
    if (one.name == name) return one.value;
  }
  throw std::runtime_error("no scalar " + name);
}

}  // namespace

TEST_CASE("A run interrupted again and again gives the bytes of one that was not") {
  const auto scene =
      small_column({{"protocol.snapshots", "{phases: [0.1, 0.5], from_cycle: 0, cycles: 2}"}});
  MemoryStore whole;
  const auto whole_store = whole.store();
  simulator::RunControl calm;
  calm.store = &whole_store;
  const auto expected = simulator::simulate(scene, calm);
  CHECK(whole.beds.size() == 2);  // the poured and the prepared bed; the checkpoint is gone

  MemoryStore broken;
  broken.beds = whole.beds;
  const auto broken_store = broken.store();
  simulator::RunControl hasty;
  hasty.store = &broken_store;
  int polls = 0;
  hasty.stop_requested = [&polls] { return ++polls % 37 == 0; };
  int interruptions = 0;
  std::optional<simulator::Record> record;
  while (!record) {
    try {
      record = simulator::simulate(scene, hasty);
    } catch (const files::Interrupted&) {
      REQUIRE(++interruptions < 100);
    }
  }
  CHECK(interruptions > 5);
  REQUIRE(record->series.size() == expected.series.size());
  for (std::size_t k = 0; k < expected.series.size(); ++k) {
    INFO(expected.series[k].name);
    CHECK((record->series[k].values == expected.series[k].values));
  }
  REQUIRE(record->snapshots.size() == 4);
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK(record->snapshots[k].name == expected.snapshots[k].name);
    CHECK((record->snapshots[k].position == expected.snapshots[k].position));
    CHECK((record->snapshots[k].tangential_force == expected.snapshots[k].tangential_force));
  }
  CHECK(scalar_of(*record, "contact_steps") == scalar_of(expected, "contact_steps"));
}

TEST_CASE("The plain stepper sees the same bed, before chaos") {
  const std::vector<simulator::Override> first_steps{{"protocol.measure.cycles", "1"},
                                                     {"base.drive.frequency", "2"},
                                                     {"base.drive.amplitude", "0.03"}};
  auto fast = first_steps;
  auto plain = first_steps;
  plain.push_back({"protocol.engine", "uniform"});
  const auto a = simulator::simulate(small_column(fast));
  const auto b = simulator::simulate(small_column(plain));
  for (const auto* name : {"large_height", "small_velocity", "coordination", "base_force"}) {
    const auto& x = series_of(a, name);
    const auto& y = series_of(b, name);
    REQUIRE(x.size() == 160);
    for (std::size_t k = 0; k < x.size(); ++k) REQUIRE(x[k] == Approx(y[k]).margin(1e-6));
  }
}

// Force balance at rest: what base and side wall carry is the weight; of a bed that was poured,
// wall friction carries part of it (Janssen 1895).
TEST_CASE("A bed at rest weighs on base and side wall together what its grains weigh") {
  auto physics = tests::physics_of(tests::table_grain, tests::table_wall, 2e-4, 2.5);
  auto grains = simulator::fill_column({2.5, 300, 0.9, 1.1, true, 1.7, 7.09}, 3);
  physics.drag.background = 1;
  simulator::ColumnStepper<tests::LinearColumn> mover(physics, grains);
  mover.advance(200'000);
  double weight = 0;
  for (const double m : grains.mass) weight += m;
  double base = 0;
  double side = 0;
  constexpr int looks = 100;
  for (int look = 0; look < looks; ++look) {
    mover.advance(50);
    simulator::WallForces walls;
    for (const auto& c : mover.wall_contacts()) simulator::add_wall_force(walls, c);
    base -= walls.base_vertical / looks;
    side -= walls.side_vertical / looks;
  }
  CHECK(base + side == Approx(weight).epsilon(5e-3));
  CHECK(side > 0.1 * weight);
  CHECK(base > 0.1 * weight);
}

TEST_CASE("A prepared bed is packed, at rest, and not wedged") {
  const auto scene = small_column({{"grains.count", "300"}});
  using Physics = tests::LinearColumn;
  const auto bed = simulator::prepared_bed<Physics>(scene, {});
  CHECK(bed.kinetic_energy < 1e-6);
  const double area = scene.cell_area();
  const double fraction = (300 + std::pow(scene.column->large_diameter, 3)) *
                          simulator::grain_volume / area / bed.height;
  CHECK(fraction > 0.5);  // in a cylinder of 5 d the walls cost some of 0.62
  CHECK(fraction < 0.64);
  const auto p = simulator::bind_column(scene);
  auto physics = simulator::bind_column_physics<Physics>(scene, p.time_step, p.steps_per_cycle);
  physics.base = {0, 0};
  const simulator::ColumnStepper<Physics> mover(physics, bed.grains, 0, bed.memory);
  double weight = 0;
  for (const double m : bed.grains.mass) weight += m;
  for (const auto& c : mover.contacts()) REQUIRE(c.normal_force < weight);
  CHECK(bed.grains.position[2][0] < bed.grains.radius[0] + 0.2);
}

// Sharing must not show: a bed that starts from the packing of a scene with other friction has the
// bytes of one that was poured for itself.
TEST_CASE("A bed that uses another scene's packing is the bed it would have poured itself") {
  const auto rough = small_column({{"grains.count", "100"}});
  const auto smooth_wall =
      small_column({{"grains.count", "100"}, {"container.wall.friction", "0"}});
  using SmoothWall = simulator::ColumnPhysics<simulator::LinearOverlap, simulator::CundallStrack,
                                              simulator::Frictionless>;
  const auto bytes_of = [](simulator::PreparedBed bed) {
    simulator::ByteWriter writer;
    bed.archive(writer);
    return std::move(writer).take();
  };
  MemoryStore shared;
  const auto store = shared.store();
  simulator::RunControl control;
  control.store = &store;
  simulator::prepared_bed<tests::LinearColumn>(rough, control);
  CHECK(shared.saves == 2);
  const auto bed = simulator::prepared_bed<SmoothWall>(smooth_wall, control);
  CHECK(shared.loads == 1);
  CHECK(shared.saves == 3);
  CHECK(bytes_of(bed) == bytes_of(simulator::prepared_bed<SmoothWall>(smooth_wall, {})));
}

TEST_CASE("Small grains of several sizes have their masses and inertias") {
  const auto grains = simulator::fill_column({4, 2000, 0.9, 1.1, true, 3, 7.09}, 3);
  CHECK(grains.mass[0] == Approx(7.09 * 27));
  double mean = 0;
  double smallest = 2;
  double largest = 0;
  for (std::size_t i = 1; i < grains.count(); ++i) {
    const double diameter = 2 * grains.radius[i];
    REQUIRE(grains.mass[i] == Approx(std::pow(diameter, 3)));
    REQUIRE(grains.inertia(i) == Approx(0.1 * std::pow(diameter, 5)));
    smallest = std::min(smallest, diameter);
    largest = std::max(largest, diameter);
    mean += diameter / 2000;
  }
  CHECK(smallest > 0.9);
  CHECK(smallest < 0.902);
  CHECK(largest < 1.1);
  CHECK(largest > 1.098);
  CHECK(mean ==
        Approx(1).margin(0.006));  // 4.6 standard errors of a uniform mean: 1e-5 false alarms
}

TEST_CASE("A filled column overlaps nothing and nobody") {
  const auto grains = simulator::fill_column({3, 300, 0.9, 1.1, true, 2, 7.09}, 3);
  for (std::size_t i = 0; i < grains.count(); ++i) {
    const auto x = simulator::row(grains.position, i);
    REQUIRE(std::hypot(x[0], x[1]) + grains.radius[i] < 3);
    REQUIRE(x[2] > grains.radius[i]);
    for (std::size_t j = 0; j < i; ++j) {
      REQUIRE((x - simulator::row(grains.position, j)).norm() >
              grains.radius[i] + grains.radius[j]);
    }
  }
  CHECK_THROWS_AS(simulator::fill_column({0.5, 3, 1, 1, false, 0, 0}, 1), files::Error);
}

TEST_CASE("The rise time is where the large grain's top meets the surface for good") {
  constexpr long phases = 4;
  const auto series_of = [](const std::vector<double>& tops) {
    simulator::ColumnSeries series;
    simulator::SizedGrains grains;
    grains.resize_to(2);
    for (std::size_t cycle = 0; cycle < tops.size(); ++cycle) {
      // The packed bed is 8 high; then it flies, as high as it likes. Tops are over its bottom.
      const double flies = 100.0 * static_cast<double>(cycle);
      grains.position[2][0] = tops[cycle] - 1 + flies;
      grains.position[2][1] = 4 + flies;
      for (int phase = 0; phase < phases; ++phase) {
        series.sample(grains, true, {0, 0}, {}, {0, 0}, false);
      }
    }
    return series;
  };
  // Cycle 3 (whose middle is 3.5): 7 < 8; cycle 4 (4.5): 9 > 8; half-way between.
  CHECK(simulator::rise_time(series_of({1, 3, 5, 7, 9, 11}), phases, 1) == Approx(4));
  CHECK(simulator::rise_time(series_of({1, 9, 7.5, 8.5}), phases, 1) == Approx(1.5 - 1. / 8));
  CHECK(simulator::rise_time(series_of({1, 9, 6.5, 7.5, 8.5}), phases, 1) == Approx(4));
  CHECK(simulator::rise_time(series_of({9, 9}), phases, 1) == 0);
  CHECK(std::isnan(simulator::rise_time(series_of({1, 9, 6}), phases, 1)));
  CHECK(std::isnan(simulator::rise_time(series_of({1, 3, 5}), phases, 1)));
}
