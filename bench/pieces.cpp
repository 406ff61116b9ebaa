#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "simulator/boundary/base.hpp"
#include "simulator/contact/contact.hpp"
#include "simulator/contact/frictionless.hpp"
#include "simulator/contact/linear_spring_dashpot.hpp"
#include "simulator/contact/viscous_coulomb.hpp"
#include "simulator/grains/filling.hpp"
#include "simulator/motion/neighbours.hpp"

// What a step is made of, one piece at a time. Compare two builds on the same machine in turns:
// the numbers are not comparable between machines.
namespace {

using namespace shakebed::simulator;

const ContactKind kind{0.5, 1e5, 15, 15, 0.4, 0.9};

template <class Tangential>
void contact_law(benchmark::State& state) {
  const Contact<3, LinearSpringDashpot, Tangential> contact(kind);
  const Vector<3> n = Vector<3>(1, 2, 3).normalized();
  Vector<3> v(0.3, -0.2, 0.7);
  const Spin<3> spin_radius(0.1, 0.2, -0.3);
  for (auto _ : state) {
    benchmark::DoNotOptimize(v);
    auto force = contact(n, 0.01, v, spin_radius);
    benchmark::DoNotOptimize(force);
  }
}
BENCHMARK(contact_law<Frictionless>);
BENCHMARK(contact_law<ViscousCoulomb>);

void base_motion(benchmark::State& state) {
  const BaseMotion base{1, 5};
  double cycles = 0.1;
  for (auto _ : state) {
    benchmark::DoNotOptimize(cycles);
    auto now = base.at(cycles);
    benchmark::DoNotOptimize(now);
  }
}
BENCHMARK(base_motion);

/// Time per build of the list, reach 1.5 d, four layers.
void list_build(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const double width = std::sqrt(static_cast<double>(count) / 4);
  const PeriodicCell<3> cell{{width, width}};
  const auto grains = fill<3, false>(count, cell, 1);
  NeighbourSearch<3> search(cell);
  std::vector<NeighbourPair<3>> pairs;
  for (auto _ : state) {
    search.find(grains.position, 1.5, pairs);
    benchmark::DoNotOptimize(pairs.data());
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(count) * state.iterations());
}
BENCHMARK(list_build)->Arg(100)->Arg(1000)->Arg(10000);

}  // namespace

BENCHMARK_MAIN();
