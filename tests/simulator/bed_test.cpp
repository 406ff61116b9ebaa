// How a scene becomes numbers, grains and a record.
#include <catch2/catch.hpp>
#include <cstring>
#include <numbers>

#include "simulator/bed.hpp"
#include "simulator/contact/frictionless.hpp"
#include "simulator/simulate.hpp"

namespace shakebed::tests {
namespace {

using simulator::Record;
using simulator::Scene;

Scene small_bed(int dimension, double friction) {
  Scene scene;
  scene.dimension = dimension;
  scene.cell.assign(dimension - 1, dimension == 2 ? 5.0 : 3.0);
  scene.grains = {dimension == 2 ? 15 : 18, dimension == 2 ? 3.0 : 2.0, 0.9, friction};
  scene.base = {{1, 3}, 0.9, friction};
  if (friction > 0) scene.contact.tangential = simulator::TangentialLaw::viscous_coulomb;
  scene.protocol.cycles = 20;
  scene.protocol.transient = 5;
  scene.seed = 3;
  return scene;
}

/// Every number of a record but its timing, as bytes.
std::vector<unsigned char> bytes(const Record& record) {
  std::vector<double> numbers{static_cast<double>(record.seed),
                              static_cast<double>(record.stationary)};
  for (const auto& q : record.quantities) {
    numbers.insert(numbers.end(), {q.estimate.mean, q.estimate.standard_error});
  }
  for (const auto& s : record.scalars) numbers.push_back(s.value);
  for (const auto& s : record.series) {
    numbers.insert(numbers.end(), s.values.begin(), s.values.end());
  }
  for (const auto& c : record.profile.columns) {
    numbers.insert(numbers.end(), c.mean.begin(), c.mean.end());
    numbers.insert(numbers.end(), c.standard_error.begin(), c.standard_error.end());
  }
  std::vector<unsigned char> raw(numbers.size() * sizeof(double));
  std::memcpy(raw.data(), numbers.data(), raw.size());
  for (const char letter : record.stationary_reason + record.canonical_scene) {
    raw.push_back(static_cast<unsigned char>(letter));
  }
  return raw;
}

}  // namespace

TEST_CASE("determinism: the same scene gives the same bytes, another seed others") {
  for (const int dimension : {2, 3}) {
    for (const double friction : {0.0, 0.4}) {
      for (const auto engine : {simulator::Engine::uniform, simulator::Engine::automatic}) {
        auto scene = small_bed(dimension, friction);
        scene.protocol.engine = engine;
        const auto first = bytes(simulator::simulate(scene));
        const bool same = first == bytes(simulator::simulate(scene));
        CHECK(same);
        scene.seed = 4;
        const bool unlike = first != bytes(simulator::simulate(scene));
        CHECK(unlike);
      }
    }
  }
}

TEST_CASE("determinism: watching a run does not change it") {
  const auto scene = small_bed(3, 0.4);
  double progress = 0;
  bool in_order = true;
  simulator::RunControl control;
  control.stop_requested = [] { return false; };
  control.on_progress = [&](double fraction) {
    in_order = in_order && fraction >= progress && fraction <= 1;
    progress = fraction;
  };
  const bool same = bytes(simulator::simulate(scene)) == bytes(simulator::simulate(scene, control));
  CHECK(same);
  CHECK(in_order);
  CHECK(progress > 0.9);
}

TEST_CASE("control: a stop is heard while settling and while measuring") {
  const auto scene = small_bed(2, 0);
  for (const int polls : {1, 30}) {
    int asked = 0;
    simulator::RunControl control;
    control.stop_requested = [&] { return ++asked >= polls; };
    CHECK_THROWS_AS(simulator::simulate(scene, control), files::Interrupted);
    CHECK(asked == polls);
  }
}

TEST_CASE("verdict: simulated beds say why they are not stationary") {
  auto scene = small_bed(2, 0);
  SECTION("too few flights") {
    scene.base.drive = {1, 20};  // W = 400: 20 cycles are 0.16 flights
    const auto record = simulator::simulate(scene);
    CHECK_FALSE(record.stationary);
    CHECK(record.stationary_reason.find("flight times") != std::string::npos);
  }
  SECTION("e = 1") {
    scene.grains.restitution = scene.base.restitution = 1;
    const auto record = simulator::simulate(scene);
    CHECK_FALSE(record.stationary);
    CHECK(record.stationary_reason.find("e = 1") != std::string::npos);
  }
  SECTION("grains that never meet") {
    scene.grains = {3, 0.6, 0.9, 0};  // a place of its own for each of them
    scene.protocol.cycles = 100;
    const auto record = simulator::simulate(scene);
    CHECK_FALSE(record.at_rest);
    CHECK_FALSE(record.stationary);
    CHECK(record.stationary_reason.find("never meet") != std::string::npos);
  }
  SECTION("long enough, it is") {
    scene.protocol.transient = 50;
    scene.protocol.cycles = 300;
    const auto record = simulator::simulate(scene);
    CHECK(record.stationary);
    CHECK_FALSE(record.at_rest);
  }
}

// k_n = 2e4 max(1, N/4) max(m V_p^2/min(A, d)^2, m g/d); m_eff = 1/2 and 1; t_c of the shorter
// contact; dt divides the period into a multiple of 64 steps, at most the share asked for.
TEST_CASE("parameters: stiffness, damping and time step follow from the scene") {
  auto scene = small_bed(3, 0.4);
  auto p = simulator::bind_parameters(scene);
  CHECK(p.stiffness == Approx(2e4 * 9));
  scene.base.drive = {0.1, 3};  // the same V_p by a tenth of the amplitude, ten times as fast
  scene.base.drive.angular_frequency = 30;
  CHECK(simulator::bind_parameters(scene).stiffness == Approx(2e4 * 9 * 100));
  scene.base.drive = {1, 0.1};
  scene.grains.layers = 8;
  CHECK(simulator::bind_parameters(scene).stiffness == Approx(2e4 * 2));
  scene.contact.stiffness = 1e5;
  scene.grains.restitution = 0.8;
  p = simulator::bind_parameters(scene);
  CHECK(p.grain_grain.effective_mass == 0.5);
  CHECK(p.grain_base.effective_mass == 1);
  for (const auto* kind : {&p.grain_grain, &p.grain_base}) {
    const double t_c = kind->contact_duration();
    // e = exp(-c_n t_c/(2 m_eff)).
    CHECK(std::exp(-kind->normal_damping * t_c / (2 * kind->effective_mass)) ==
          Approx(kind->restitution));
    CHECK(kind->tangential_damping == kind->normal_damping);
  }
  CHECK(p.grain_grain.restitution == 0.8);
  CHECK(p.grain_base.restitution == 0.9);
  CHECK(p.contact_duration == p.grain_grain.contact_duration());
  CHECK(p.steps_per_cycle % 64 == 0);
  CHECK(p.time_step <= 0.02 * p.contact_duration);
  CHECK(p.time_step > 0.0199 * p.contact_duration);
  CHECK(p.time_step * static_cast<double>(p.steps_per_cycle) == Approx(scene.base.drive.period()));
  scene.contact.damping = simulator::TangentialDamping::critical;
  p = simulator::bind_parameters(scene);
  CHECK(p.grain_grain.tangential_damping == Approx(2 * std::sqrt(1e5 * 0.5)));
  CHECK(p.grain_base.tangential_damping == Approx(2 * std::sqrt(1e5)));
}

TEMPLATE_TEST_CASE_SIG("filling: no two grains touch, none touches the base", "", ((int D), D), 2,
                       3) {
  for (const double width : {2.2, 3.14, 5.0, 10.0}) {
    simulator::PeriodicCell<D> cell;
    cell.width.fill(width);
    for (const std::size_t count : {1, 7, 60}) {
      for (const std::uint64_t seed : {1, 2, 3}) {
        const auto grains = simulator::fill<D, false>(count, cell, seed);
        REQUIRE(grains.count() == count);
        for (std::size_t i = 0; i < count; ++i) {
          REQUIRE(grains.position[D - 1][i] > 0.5);
          for (std::size_t j = 0; j < i; ++j) {
            simulator::Vector<D> nearest =
                simulator::row(grains.position, j) - simulator::row(grains.position, i);
            for (int c = 0; c < D - 1; ++c) nearest[c] += cell.image_shift(c, nearest[c]);
            REQUIRE(nearest.norm() > 1);
          }
        }
      }
    }
  }
}

// A settled bed is dense and low: in 2D a row of 5 discs in 5 d is full, so three rows lie at about
// 1/2, 1/2 + 0.87 to 1, ... and its centre of mass between the triangular and the square stack.
TEST_CASE("settling: the bed ends at rest on the base, and starts with the base's velocity") {
  const auto scene = small_bed(2, 0);
  using Physics = simulator::BedPhysics<2, simulator::Frictionless>;
  const auto bed = simulator::settle<Physics>(scene, {});
  const double row_height = std::numbers::sqrt3 / 2;
  CHECK(bed.rest_height > 0.5 + row_height - 0.01);
  CHECK(bed.rest_height < 1.51);
  for (const double z : bed.grains.position[1]) CHECK(z > 0.49);
  for (const double w : bed.grains.velocity[1]) CHECK(w == scene.base.drive.peak_velocity());
  for (const double u : bed.grains.velocity[0]) CHECK(u == 0);
}

}  // namespace shakebed::tests
