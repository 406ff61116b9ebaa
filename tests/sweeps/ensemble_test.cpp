#include "sweeps/ensemble.hpp"

#include <signal.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <map>
#include <thread>

#include "files/error.hpp"
#include "simulator/scene/read_scene.hpp"
#include "sweeps/cost_model.hpp"
#include "sweeps/stop_signals.hpp"
#include "tests/sweeps/small_sweep.hpp"

namespace shakebed::tests {
namespace {

namespace fs = std::filesystem;
using simulator::Record;
using simulator::RunControl;
using simulator::Scene;
using sweeps::EnsembleOptions;
using sweeps::run_ensemble;
using sweeps::store::Cache;

const std::string twelve_points =
    "axes:\n  - {key: base.drive.W, range: {from: 1.5, to: 7, step: 0.5}}\nreplicates: 2\n";

/// Every byte of the run files below, by name. Timing is part of them: pretended records have none.
std::map<std::string, std::string> contents(const Cache& cache) {
  std::map<std::string, std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(cache.folder())) {
    if (entry.is_regular_file()) {
      found[entry.path().filename().string()] = files::read_text(entry.path());
    }
  }
  return found;
}

std::size_t run_files(const Cache& cache) {
  std::size_t count = 0;
  if (!fs::exists(cache.folder())) return 0;
  for (const auto& entry : fs::recursive_directory_iterator(cache.folder())) {
    count += entry.path().extension() == ".h5";
  }
  return count;
}

Record pretend(const Scene& scene, const RunControl&) { return pretended_record(scene); }

// What a bed does with its threads is tested in tests/column.
TEST_CASE("Cores that have no bed of their own help with one in a container, and with no other") {
  const SmallSweep small;
  auto runs = sweeps::runs_of(small.grid(twelve_points));
  runs.resize(2);
  const auto threads_seen = [&](int jobs, const std::string& name) {
    std::atomic<int> most = 0;
    const auto count = [&](const Scene& scene, const RunControl& control) {
      most = std::max(most.load(), simulator::threads_of(control));
      return pretended_record(scene);
    };
    run_ensemble(runs, Cache(small.folder.path() / name), count, {jobs, {}, nullptr});
    return most.load();
  };
  CHECK(threads_seen(4, "periodic") == 1);
  for (auto& run : runs) {
    run.scene =
        simulator::read_scene(SHAKEBED_SCENES "/brazil_nut.yaml", {{"grains.count", "1700"}});
  }
  CHECK(threads_seen(1, "one core") == 1);
  CHECK(threads_seen(2, "a core each") == 1);
  CHECK(threads_seen(6, "three each") == 3);
  CHECK(threads_seen(64, "more than blocks") == 4);
}

TEST_CASE("Data sets are the same for any number of threads and after an interruption") {
  const SmallSweep small;
  const auto runs = sweeps::runs_of(small.grid(twelve_points));
  const Cache one(small.folder.path() / "one");
  const Cache two(small.folder.path() / "two");
  const Cache resumed(small.folder.path() / "resumed");
  CHECK(run_ensemble(runs, one, pretend, {1, {}, nullptr}).finished == 24);
  CHECK(run_ensemble(runs, two, pretend, {2, {}, nullptr}).finished == 24);

  std::atomic<int> begun = 0;
  const auto counting = [&](const Scene& scene, const RunControl& control) {
    ++begun;
    if (control.stop_requested()) throw files::Interrupted();
    return pretended_record(scene);
  };
  const auto first =
      run_ensemble(runs, resumed, counting, {2, [&] { return begun >= 8; }, nullptr});
  CHECK(first.interrupted);
  CHECK(first.finished < 8);
  CHECK(first.finished == run_files(resumed));
  CHECK(first.failures.empty());
  const auto second = run_ensemble(runs, resumed, pretend, {2, {}, nullptr});
  CHECK_FALSE(second.interrupted);
  CHECK(second.cached == first.finished);
  CHECK(second.finished == 24 - first.finished);

  const auto expected = contents(one);
  CHECK(expected.size() == 25);  // and LAYOUT
  CHECK((contents(two) == expected));
  CHECK((contents(resumed) == expected));
}

TEST_CASE("A second run simulates nothing and touches no file") {
  const SmallSweep small;
  const auto runs = sweeps::runs_of(small.grid(twelve_points));
  const Cache cache(small.folder.path() / "cache");
  run_ensemble(runs, cache, pretend, {2, {}, nullptr});
  std::map<std::string, fs::file_time_type> times;
  for (const auto& entry : fs::recursive_directory_iterator(cache.folder())) {
    times[entry.path().string()] = entry.last_write_time();
  }
  const auto never = [](const Scene&, const RunControl&) -> Record {
    throw std::logic_error("a cached bed was simulated");
  };
  const auto report = run_ensemble(runs, cache, never, {2, {}, nullptr});
  CHECK(report.cached == 24);
  CHECK(report.finished == 0);
  for (const auto& entry : fs::recursive_directory_iterator(cache.folder())) {
    CHECK(times.at(entry.path().string()) == entry.last_write_time());
  }
}

TEST_CASE("The dearest bed starts first") {
  const SmallSweep small;
  const auto runs = sweeps::runs_of(small.grid(twelve_points));
  std::vector<double> costs;
  const auto noting = [&](const Scene& scene, const RunControl&) {
    costs.push_back(sweeps::predicted_cpu_seconds(scene));
    return pretended_record(scene);
  };
  run_ensemble(runs, Cache(small.folder.path() / "cache"), noting, {1, {}, nullptr});
  REQUIRE(costs.size() == 24);
  CHECK(std::is_sorted(costs.rbegin(), costs.rend()));
  CHECK(costs.front() > costs.back());
}

TEST_CASE("A failing bed is reported with its message and does not hinder the others") {
  const SmallSweep small;
  const auto runs = sweeps::runs_of(small.grid(twelve_points));
  const Cache cache(small.folder.path() / "cache");
  const auto bad = [&](const Scene& scene) { return scene.seed == runs[5].scene.seed; };
  const auto failing = [&](const Scene& scene, const RunControl&) {
    if (bad(scene)) throw files::failed("", "the bed never settles");
    return pretended_record(scene);
  };
  const auto report = run_ensemble(runs, cache, failing, {2, {}, nullptr});
  CHECK(report.finished == 23);
  REQUIRE(report.failures.size() == 1);
  CHECK(report.failures[0].run == 5);
  CHECK(report.failures[0].message == "the bed never settles");
  CHECK_FALSE(report.interrupted);
  CHECK(cache.failure_of(runs[5].identity.key) == "the bed never settles");

  const auto again = run_ensemble(runs, cache, pretend, {2, {}, nullptr});
  CHECK(again.cached == 23);
  CHECK(again.finished == 1);
  CHECK_FALSE(cache.failure_of(runs[5].identity.key));
}

TEST_CASE("A damaged cached run is made again, and said") {
  const SmallSweep small;
  const auto runs = sweeps::runs_of(small.grid(twelve_points));
  const Cache cache(small.folder.path() / "cache");
  run_ensemble(runs, cache, pretend, {2, {}, nullptr});
  const auto before = contents(cache);
  const auto victim = cache.file_of(runs[3].identity.key);
  files::write_text(victim, files::read_text(victim).substr(0, 1000));
  const auto report = run_ensemble(runs, cache, pretend, {2, {}, nullptr});
  CHECK(report.finished == 1);
  REQUIRE(report.made_again.size() == 1);
  CHECK_THAT(report.made_again[0], Catch::Contains(victim.string()));
  CHECK((contents(cache) == before));
}

TEST_CASE("Points that coincide are simulated once") {
  const SmallSweep small;
  const auto runs =
      sweeps::runs_of(small.grid("axes: [{key: base.drive.W, values: [2, 2.0, 2]}]\n"));
  CHECK(run_ensemble(runs, Cache(small.folder.path() / "cache"), pretend, {2, {}, nullptr})
            .finished == 1);
}

TEST_CASE("Records live only until they are written, however many points there are") {
  const SmallSweep small;
  const Cache cache(small.folder.path() / "cache");
  for (const int points : {10, 60}) {
    const auto runs = sweeps::runs_of(
        small.grid("axes: [{key: base.drive.W, range: {from: 1, to: " + std::to_string(points) +
                   ", step: 0.5}}]\n"));
    std::atomic<std::size_t> begun = run_files(cache);
    std::atomic<std::size_t> most_alive = 0;
    const auto counting = [&](const Scene& scene, const RunControl&) {
      // A record may exist from when its bed begins until its file is there.
      const std::size_t alive = ++begun - run_files(cache);
      std::size_t seen = most_alive;
      while (alive > seen && !most_alive.compare_exchange_weak(seen, alive)) {
      }
      return pretended_record(scene);
    };
    run_ensemble(runs, cache, counting, {3, {}, nullptr});
    CHECK(run_files(cache) == runs.size());
    CHECK(most_alive <= 3);
  }
}

TEST_CASE("A cache that cannot be written stops the beds instead of losing their work") {
  const SmallSweep small;
  const auto runs = sweeps::runs_of(small.grid(twelve_points));
  const Cache cache(small.folder.path() / "cache");
  files::write_text(cache.folder() / "LAYOUT", "shakebed cache, layout 1\n");
  for (const auto& run : runs) {  // a file where the folder should be
    files::write_text(cache.folder() / run.identity.key.substr(0, 2), "in the way");
  }
  std::atomic<int> begun = 0;
  std::atomic<bool> told_to_stop = false;
  const auto first_is_long = [&](const Scene& scene, const RunControl& control) {
    if (++begun == 1) {
      const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(20);
      while (!control.stop_requested() && std::chrono::steady_clock::now() < patience) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      told_to_stop = control.stop_requested();
      throw files::Interrupted();
    }
    return pretended_record(scene);
  };
  CHECK_THROWS_AS(run_ensemble(runs, cache, first_is_long, {2, {}, nullptr}), files::Error);
  CHECK(told_to_stop);
  CHECK(begun <= 4);
  CHECK(run_files(cache) == 0);
}

TEST_CASE("SIGINT and SIGTERM keep what is finished") {
  const SmallSweep small;
  const auto runs = sweeps::runs_of(small.grid(twelve_points));
  for (const int signal : {SIGINT, SIGTERM}) {
    const Cache cache(small.folder.path() / ("cache" + std::to_string(signal)));
    const sweeps::StopSignals signals;
    std::atomic<int> begun = 0;
    const auto bed = [&](const Scene& scene, const RunControl& control) {
      if (++begun == 6) ::raise(signal);
      if (control.stop_requested()) throw files::Interrupted();
      return pretended_record(scene);
    };
    const auto report = run_ensemble(runs, cache, bed, {2, sweeps::StopSignals::raised, nullptr});
    CHECK(report.interrupted);
    CHECK(report.finished >= 4);
    CHECK(report.finished <= 6);
    CHECK(run_files(cache) == report.finished);
    CHECK(report.failures.empty());
    for (const auto& [name, bytes] : contents(cache)) CHECK(name.find(".tmp") == std::string::npos);
  }
  CHECK(run_ensemble(runs, Cache(small.folder.path() / ("cache" + std::to_string(SIGINT))), pretend,
                     {2, [] { return false; }, nullptr})
            .finished > 0);
}

TEST_CASE("Progress reaches the whole predicted cost, whatever the beds report") {
  const SmallSweep small;
  const auto runs = sweeps::runs_of(small.grid(twelve_points));
  std::ostringstream text;
  double now = 0;
  sweeps::Progress progress(text, false, "small", [&] { return now; });
  const auto bed = [&](const Scene& scene, const RunControl& control) {
    now += 11;
    for (const double share : {0.25, 0.2, 0.5}) control.on_progress(share);
    return pretended_record(scene);
  };
  run_ensemble(runs, Cache(small.folder.path() / "cache"), bed, {1, {}, &progress});
  CHECK_THAT(text.str(), Catch::Contains("24 of 24 beds, 100 %"));
}

}  // namespace
}  // namespace shakebed::tests
