#include <catch2/catch.hpp>
#include <cstddef>
#include <new>
#include <string>

#include "simulator/bed.hpp"
#include "simulator/contact/frictionless.hpp"
#include "simulator/contact/viscous_coulomb.hpp"
#include "simulator/scene/read_scene.hpp"
#include "simulator/simulate.hpp"
#include "tests/memory/counted_allocations.hpp"

namespace {

using namespace shakebed;
using namespace shakebed::simulator;

/// The bed of a hundred grains that the limits below are meant for.
Scene hundred_grains(int dimension, double friction, double W, long cycles) {
  const std::string cell = dimension == 3 ? "[5, 5]" : "[25]";
  return read_scene(files::YamlNode::load_text(
      "scene: 1\ndimension: " + std::to_string(dimension) +
          "\ngrains: {count: 100, restitution: 0.9, friction: " + std::to_string(friction) +
          "}\ncell: " + cell + "\nbase: {drive: {W: " + std::to_string(W) +
          ", amplitude: 1}}\n"
          "contact: {stiffness: 2e4}\nprotocol: {settle: 5, transient: {cycles: 5}, measure: "
          "{cycles: " +
          std::to_string(cycles) + "}}\n",
      "hundred grains"));
}

struct Used {
  std::size_t peak;  ///< bytes while the bed runs
  std::size_t left;  ///< bytes of the record
};

Used bytes_of(const Scene& scene) {
  const std::size_t before = tests::allocations().live_bytes;
  tests::reset_peak();
  const Record record = simulate(scene);
  const auto after = tests::allocations();
  return {after.peak_bytes - before, after.live_bytes - before};
}

/// Steps on which memory was allocated though no list was built, out of `steps`.
template <class Physics>
long allocating_steps(const Scene& scene, long steps) {
  const Parameters p = bind_parameters(scene);
  const auto bed = settle<Physics>(scene, {});
  UniformStepper<Physics> mover(bind_physics<Physics>(scene, p), bed.grains);
  mover.advance(p.steps_per_cycle);
  long allocating = 0;
  for (long step = 0; step < steps; ++step) {
    const long calls = tests::allocations().calls;
    const long builds = mover.list_builds();
    mover.advance(1);
    const bool built = mover.list_builds() > builds;
    if (!built && tests::allocations().calls > calls) ++allocating;
  }
  CHECK(mover.list_builds() > 10);         // there was something to leave out
  CHECK(mover.ledger().collisions > 100);  // and contacts, fresh ones, to step through
  return allocating;
}

}  // namespace

TEST_CASE("The counter sees what is allocated") {
  const auto before = tests::allocations();
  tests::reset_peak();
  void* memory = ::operator new(8000);  // not a new-expression, which a compiler may leave out
  const auto during = tests::allocations();
  ::operator delete(memory);
  const auto after = tests::allocations();
  CHECK(during.calls == before.calls + 1);
  CHECK(during.live_bytes >= before.live_bytes + 8000);
  CHECK(after.live_bytes == before.live_bytes);
  CHECK(after.peak_bytes >= before.live_bytes + 8000);
}

TEST_CASE("A bed of a hundred grains needs less than 1 MB") {
  for (const int dimension : {2, 3}) {
    for (const double friction : {0.0, 0.4}) {
      // At W = 89.4, the highest in the paper, grains fly to hundreds of d: the tallest profile.
      for (const double W : {5.6, 89.4}) {
        const auto used = bytes_of(hundred_grains(dimension, friction, W, 80));
        CAPTURE(dimension, friction, W, used.peak, used.left);
        CHECK(used.peak < 1'000'000);
        CHECK(used.peak > 10'000);  // a hundred grains' state alone, so the counter was on
      }
    }
  }
}

TEST_CASE("A run three times as long needs hardly more memory") {
  auto few = hundred_grains(2, 0, 5.6, 3000);  // more cycles than a series has entries: it merged
  few.grains.count = 20;
  few.cell = {5};
  few.protocol.time_step_fraction = 0.1;
  const auto brief = bytes_of(few);
  few.protocol.cycles = 9000;
  const auto longer = bytes_of(few);
  CAPTURE(brief.peak, longer.peak);
  // A single series of doubles that never merged would add 48 kB; a bed has more than one.
  CHECK(longer.peak < brief.peak + 48'000);
}

TEST_CASE("A step of the uniform engine allocates nothing but with a list build") {
  const auto rough = hundred_grains(3, 0.4, 22.36, 1);
  CHECK(allocating_steps<BedPhysics<3, ViscousCoulomb>>(rough, 20000) == 0);
  const auto smooth = hundred_grains(2, 0, 22.36, 1);
  CHECK(allocating_steps<BedPhysics<2, Frictionless>>(smooth, 20000) == 0);
}
