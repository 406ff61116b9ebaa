#include <benchmark/benchmark.h>
#include <malloc.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <new>

#include "fitting/networks/analysis.hpp"
#include "tests/networks/packing.hpp"

// Speed and memory of the networks room against the number of grains: made-up beds of Sun's height
// and density (tests/networks/packing.hpp), the cylinder wider for more grains, four of them flying
// 30 d above. Times are CPU times of one thread.

namespace {

std::size_t live = 0, peak = 0;

void* counted(std::size_t size) {
  void* memory = std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  live += malloc_usable_size(memory);
  peak = std::max(peak, live);
  return memory;
}

void release(void* memory) {
  live -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { release(memory); }

namespace {

namespace networks = shakebed::fitting::networks;

const networks::Snapshot& bed(std::int64_t grains) {
  static std::map<std::int64_t, networks::Snapshot> beds;
  const auto found = beds.find(grains);
  if (found != beds.end()) return found->second;
  shakebed::tests::PackingOptions options;
  options.small_grains = static_cast<std::size_t>(grains) - 5;
  options.cylinder_diameter = 12.25 * std::sqrt(static_cast<double>(grains) / 7601);
  options.flying = 4;
  return beds.emplace(grains, shakebed::tests::packing(options, 1)).first->second;
}

void measure(benchmark::State& state, const auto& work) {
  const networks::Snapshot& snapshot = bed(state.range(0));
  std::size_t most = 0;
  for (auto _ : state) {
    peak = live;
    const std::size_t before = live;
    benchmark::DoNotOptimize(work(snapshot));
    most = std::max(most, peak - before);
  }
  state.counters["contacts"] = static_cast<double>(snapshot.contacts.size());
  state.counters["peak_bytes_per_grain"] =
      static_cast<double>(most) / static_cast<double>(snapshot.grains());
  state.SetComplexityN(state.range(0));
}

void everything(benchmark::State& state) {
  measure(state, [](const auto& snapshot) { return networks::analyse(snapshot, {}); });
}
void five_trees(benchmark::State& state) {
  measure(state,
          [](const auto& snapshot) { return networks::spanning_trees(snapshot.position, 5, 1.2); });
}
void force_networks(benchmark::State& state) {
  measure(state, [](const auto& snapshot) { return networks::force_networks(snapshot); });
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  for (const int grains : {1000, 2000, 4000, 7601, 15000, 30000, 60000, 100000}) {
    benchmark->Arg(grains);
  }
  benchmark->Unit(benchmark::kMillisecond)->Complexity(benchmark::oNLogN);
}

BENCHMARK(everything)->Apply(sizes);
BENCHMARK(five_trees)->Apply(sizes);
BENCHMARK(force_networks)->Apply(sizes);

}  // namespace

BENCHMARK_MAIN();
