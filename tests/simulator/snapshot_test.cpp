// Snapshots: what a bed looked like at an instant, and which grains pressed on each other.
#include "simulator/observables/snapshot.hpp"

#include <catch2/catch.hpp>
#include <numeric>

#include "fitting/networks/snapshot.hpp"
#include "simulator/contact/frictionless.hpp"
#include "simulator/simulate.hpp"
#include "sweeps/store/run_file.hpp"
#include "tests/simulator/scripted_mover.hpp"
#include "tests/store/example_record.hpp"

namespace shakebed::tests {
namespace {

using simulator::Snapshot;
using simulator::SnapshotContact;

/// A rough bed whose base hardly moves: W = 0.01, Gamma = 0.01.
simulator::Scene resting_bed(simulator::Engine engine) {
  simulator::Scene scene;
  scene.dimension = 3;
  scene.cell = {4, 4};
  scene.grains = {32, 2, 0.9, 0.4};
  scene.base = {{1, 0.1}, 0.9, 0.4};
  scene.contact.tangential = simulator::TangentialLaw::viscous_coulomb;
  scene.protocol.engine = engine;
  scene.protocol.transient = 2;
  scene.protocol.cycles = 1;
  scene.protocol.snapshots.phases = {0, 0.25};
  return scene;
}

double force_on_base(const Snapshot& snapshot) {
  double sum = 0;
  for (const auto& contact : snapshot.contacts) {
    if (contact.j == SnapshotContact::wall) sum += contact.normal_force;
  }
  return sum;
}

}  // namespace

// Newton: a bed that moves with the base presses on it with sum m (g + a), a = -A omega^2
// sin(phase).
TEST_CASE("snapshot: the base carries the bed, and at its top a little less") {
  for (const auto engine : {simulator::Engine::uniform, simulator::Engine::automatic}) {
    const auto record = simulator::simulate(resting_bed(engine));
    REQUIRE(record.snapshots.size() == 2);
    const auto& middle = record.snapshots[0];
    const auto& top = record.snapshots[1];
    CHECK(middle.name == "T1");  // the first quiet cycle ends the transient
    CHECK(top.name == "T1.25");
    CHECK(top.cycles == Approx(1.25).epsilon(1e-4));
    CHECK(top.base_height == Approx(1).epsilon(1e-6));
    CHECK(middle.base_velocity == Approx(0.1));
    CHECK(middle.position.size() == 32);
    CHECK(middle.spin.size() == 32);
    CHECK(force_on_base(middle) == Approx(32).epsilon(0.02));
    CHECK(force_on_base(top) == Approx(32 * (1 - 0.01)).epsilon(0.003));
    for (const auto& contact : middle.contacts) {
      CHECK((contact.j == SnapshotContact::wall || contact.i < contact.j));
    }
    for (const auto& x : middle.position) {
      CHECK((x[0] >= 0 && x[0] < 4 && x[1] >= 0 && x[1] < 4));
    }
  }
}

// k_n delta + c_n v_n by hand for two grains across the periodic boundary, two on the base.
TEST_CASE("snapshot: forces follow from positions and velocities") {
  simulator::Scene scene;
  scene.dimension = 2;
  scene.cell = {5};
  scene.grains = {3, 0.6, 0.8, 0};
  scene.base = {{1, 2}, 0.5, 0};
  scene.contact.stiffness = 1e4;
  const auto parameters = simulator::bind_parameters(scene);
  using Physics = simulator::BedPhysics<2, simulator::Frictionless>;
  const auto physics = simulator::bind_physics<Physics>(scene, parameters);
  simulator::Grains<2, false> grains;
  grains.resize_to(3);
  grains.position = {std::vector<double>{0.2, -0.75, 2.5}, std::vector<double>{0.49, 0.49, 3}};
  grains.velocity = {std::vector<double>{-1, 0, 0}, std::vector<double>{0, 2, 0}};
  const auto snapshot = simulator::snapshot_of(physics, grains, 0, 7);
  CHECK(snapshot.cycles == 7);
  CHECK(snapshot.position[1][0] == 4.25);
  CHECK(snapshot.position[1][2] == 0.49);
  CHECK(snapshot.velocity[1] == Snapshot::Triple{0, 0, 2});
  CHECK(snapshot.period == Snapshot::Triple{5, 0, 0});
  CHECK(snapshot.spin.empty());
  REQUIRE(snapshot.contacts.size() == 3);
  CHECK(snapshot.contacts[0].i == 0);
  CHECK(snapshot.contacts[0].j == 1);
  const double pair = 1e4 * 0.05 + parameters.grain_grain.normal_damping * 1;
  CHECK(snapshot.contacts[0].normal_force == Approx(pair).epsilon(1e-12));
  CHECK(snapshot.contacts[1].j == SnapshotContact::wall);
  const double base = 1e4 * 0.01 + parameters.grain_base.normal_damping * 2;  // V_p = 2, upwards
  CHECK(snapshot.contacts[1].normal_force == Approx(base).epsilon(1e-12));
  CHECK(snapshot.contacts[2].normal_force == Approx(1e4 * 0.01).epsilon(1e-12));
}

TEST_CASE("snapshot: taken at its phases, without disturbing what is sampled") {
  auto scene = scripted_scene<2>();
  scene.protocol.cycles = 3;
  scene.protocol.transient = 2;
  scene.protocol.snapshots = {{0, 0.3, 0.5}, 2};
  const auto parameters = simulator::bind_parameters(scene);
  const long steps = parameters.steps_per_cycle;
  ScriptedMover<2> mover(parameters, [](long, double) {
    return ScriptedMover<2>::Motion{1, 0, 1, 0, 0};
  });
  const simulator::RunControl control;
  simulator::Protocol<ScriptedMover<2>, 2> protocol(scene, parameters, mover, control);
  protocol.take_snapshots_with([&](long step, long cycle) {
    mover.synchronised();
    const long asked = mover.asked().back();
    CHECK(asked == cycle * steps + step);
    return Snapshot{};
  });
  simulator::Measurement<2> measurement(scene, 0);
  protocol.discard();
  protocol.measure(measurement);
  std::vector<std::string> names;
  for (const auto& snapshot : protocol.snapshots()) names.push_back(snapshot.name);
  CHECK(names == std::vector<std::string>{"T2", "T2.3", "T2.5", "T3", "T3.3", "T3.5"});
  std::vector<long> sampled = mover.asked();
  std::erase_if(sampled, [&](long step) { return step % (steps / 64) != 0; });
  CHECK(sampled.size() == 3 * 64 + 4);  // phases 0 and 0.5 lie on the grid of samples
  CHECK(mover.asked().back() == 5 * steps);
}

TEST_CASE("snapshot: the file is one that the networks read") {
  const TemporaryFolder folder;
  const auto record = simulator::simulate(resting_bed(simulator::Engine::uniform));
  const auto file = folder.path() / "run.h5";
  sweeps::store::write_run_file(file, record, {});
  const auto& mine = record.snapshots[1];
  const auto network = fitting::networks::read_snapshot_hdf5(file.string() + ":T1.25");
  REQUIRE(network.grains() == 32);
  for (std::size_t i = 0; i < 32; ++i) CHECK(network.position[i] == mine.position[i]);
  const auto walls = static_cast<std::size_t>(
      std::count_if(mine.contacts.begin(), mine.contacts.end(),
                    [](const SnapshotContact& c) { return c.j == SnapshotContact::wall; }));
  CHECK(walls >= 16 - 6);
  CHECK(network.wall_contacts == walls);
  REQUIRE(network.contacts.size() == mine.contacts.size() - walls);
  REQUIRE(network.contacts.size() > 16);
  for (std::size_t k = 0; k < network.contacts.size(); ++k) {
    CHECK(network.contacts[k].i == mine.contacts[k].i);
    CHECK(network.contacts[k].normal_force == mine.contacts[k].normal_force);
  }
}

}  // namespace shakebed::tests
