#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "bench/lammps_time.hpp"
#include "files/atomic_file.hpp"
#include "files/build_info.hpp"
#include "files/error.hpp"
#include "simulator/bed.hpp"
#include "simulator/column_preparation.hpp"
#include "simulator/contact/cundall_strack.hpp"
#include "simulator/contact/linear_overlap.hpp"
#include "simulator/scene/read_scene.hpp"
#include "sweeps/store/bed_store.hpp"
#include "sweeps/store/cache.hpp"
#include "sweeps/thread_team.hpp"
#include "tests/oracle/column_deck.hpp"

// The bed of Sun 2006 at full size against LAMMPS' gran/hooke/history: the same 7601 grains at
// T = 1.75, the same step, one core each, in turns. From there on: `stretch` steps of the expansion
// stage, on to T = 1.9 untimed, `stretch` steps of the compression stage; or (--cycle) a whole
// cycle. CPU time per grain and step; the ratio is LAMMPS' over ours. Neither knows springs older
// than T = 1.75. --alone leaves LAMMPS out; --threads N puts N threads on our bed beside one
// instead: wall time with one over that with N.
namespace {

using namespace shakebed;
using Column = simulator::ColumnPhysics<simulator::LinearOverlap, simulator::CundallStrack,
                                        simulator::CundallStrack>;

struct Options {
  std::string scene = SHAKEBED_BRAZIL_NUT;
  std::vector<std::string> set;
  int turns = 3;
  double skin = 0.5;
  long stretch = 2000;
  bool whole_cycle = false;
  bool alone = false;
  int threads = 0;
};

/// Steps of each piece, and whether it is timed.
struct Piece {
  const char* name;
  long steps;
  bool timed;
};

std::vector<Piece> pieces(const Options& options, long per_cycle) {
  // The first lists are built outside the timed steps, as LAMMPS builds them before it looks.
  constexpr long lists = 64;
  if (options.whole_cycle) return {{"lists", lists, false}, {"one cycle", per_cycle, true}};
  return {{"lists", lists, false},
          {"expansion", options.stretch, true},
          {"on to T = 1.9", per_cycle * 15 / 100 - options.stretch - lists, false},
          {"compression", options.stretch, true}};
}

Options read_options(int argc, char** argv) {
  Options options;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    const auto value = [&]() -> std::string {
      if (k + 1 == argc) throw files::bad_input(word, "needs a value");
      return argv[++k];
    };
    if (word == "--turns") {
      options.turns = std::atoi(value().c_str());
    } else if (word == "--skin") {
      options.skin = std::atof(value().c_str());
    } else if (word == "--stretch") {
      options.stretch = std::atol(value().c_str());
    } else if (word == "--set") {
      options.set.push_back(value());
    } else if (word == "--cycle") {
      options.whole_cycle = true;
    } else if (word == "--alone") {
      options.alone = true;
    } else if (word == "--threads") {
      options.threads = std::atoi(value().c_str());
    } else {
      throw files::bad_input(
          word, "expected --turns, --skin, --stretch, --set, --cycle, --alone or --threads");
    }
  }
  return options;
}

std::vector<simulator::Override> overrides(const Options& options) {
  std::vector<simulator::Override> all;
  for (const auto& one : options.set) {
    const auto equals = one.find('=');
    all.push_back({one.substr(0, equals), one.substr(equals + 1), "--set " + one});
  }
  return all;
}

std::vector<double> our_seconds(const Column& physics, const simulator::SizedGrains& start,
                                long first, const std::vector<Piece>& all, double (*now)(),
                                simulator::Crew* crew = nullptr) {
  simulator::ColumnStepper<Column> mover(physics, start, first, {}, -1, crew);
  std::vector<double> seconds;
  for (const auto& piece : all) {
    const double before = now();
    mover.advance(piece.steps);
    seconds.push_back(now() - before);
  }
  return seconds;
}

std::vector<double> lammps_seconds(const Options& options, const simulator::ColumnScene& column,
                                   const Column& physics, const simulator::SizedGrains& start,
                                   const std::vector<Piece>& all) {
  std::string pattern = (std::filesystem::temp_directory_path() / "shakebed-bench-XXXXXX").string();
  if (!::mkdtemp(pattern.data())) throw files::failed(pattern, "no temporary folder");
  const std::filesystem::path folder = pattern;
  tests::write_data(folder / "bed.data", start);
  {
    std::ofstream deck(folder / "deck.in");
    tests::write_deck_head(deck, physics, column.grain, column.wall, 0.5 * column.diameter,
                           options.skin);
    deck << "thermo 1000000\n";
    for (const auto& piece : all) deck << "run " << piece.steps << '\n';
  }
  const std::string command = "cd '" + folder.string() +
                              "' && OMP_NUM_THREADS=1 lmp -in deck.in -nocite -log none "
                              "> screen.txt 2>&1";
  const int status = std::system(command.c_str());
  const std::string screen = files::read_text(folder / "screen.txt");
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  if (status != 0) throw files::failed("lmp", "failed; it ended with:\n" + screen);
  return bench::cpu_seconds_of_runs(screen);
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void compare(const Options& options) {
  const auto scene = simulator::read_scene(options.scene, overrides(options));
  const auto parameters = simulator::bind_column(scene);
  auto physics = simulator::bind_column_physics<Column>(scene, parameters.time_step,
                                                        parameters.steps_per_cycle);
  physics.predict_velocities = false;  // as LAMMPS has them
  const auto store = sweeps::store::bed_store(sweeps::store::Cache::place(std::nullopt));
  simulator::RunControl control;
  control.store = &store;
  const auto prepared = simulator::prepared_bed<Column>(scene, control);
  auto grains = prepared.grains;
  for (double& v : grains.velocity[2]) v = physics.base.peak_velocity;
  simulator::ColumnStepper<Column> before(physics, grains, 0, prepared.memory);
  const long first = parameters.steps_per_cycle * 7 / 4;
  before.advance(first);
  const auto start = before.synchronised();

  const auto all = pieces(options, parameters.steps_per_cycle);
  std::vector<std::vector<double>> ours(all.size()), theirs(all.size()), ratios(all.size());
  const double grains_count = static_cast<double>(start.count());
  for (int turn = 0; turn < options.turns; ++turn) {
    std::vector<double> a, b(all.size(), 0.0);
    if (options.threads > 0) {
      sweeps::ThreadTeam team(options.threads);
      a = our_seconds(physics, start, first, all, wall_seconds, &team);
      b = our_seconds(physics, start, first, all, wall_seconds);
    } else {
      a = our_seconds(physics, start, first, all, simulator::thread_cpu_seconds);
      if (!options.alone) b = lammps_seconds(options, *scene.column, physics, start, all);
    }
    for (std::size_t k = 0; k < all.size(); ++k) {
      const double scale = 1e9 / (grains_count * static_cast<double>(all[k].steps));
      ours[k].push_back(a[k] * scale);
      theirs[k].push_back(b[k] * scale);
      ratios[k].push_back(b[k] / a[k]);
    }
  }
  std::printf("%zu grains, %ld steps a cycle, skin %g, %d turns, for %s\n", start.count(),
              parameters.steps_per_cycle, options.skin, options.turns,
              std::string(files::machine()).c_str());
  const std::string many = std::to_string(options.threads) + " threads [ns]";
  std::printf("%-14s %14s %14s %8s\n", "stage",
              options.threads > 0 ? "1 thread [ns]" : "LAMMPS [ns]",
              options.threads > 0 ? many.c_str() : "shakebed [ns]", "ratio");
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!all[k].timed) continue;
    std::printf("%-14s %14.1f %14.1f %8.2f\n", all[k].name, median(theirs[k]), median(ours[k]),
                median(ratios[k]));
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Options options = read_options(argc, argv);
    if (!options.alone && options.threads == 0 && !bench::lammps_is_here()) {
      std::printf(
          "no program lmp on PATH: nothing to compare with (make deps-oracle, or --alone)\n");
      return 0;
    }
    compare(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_column: error: %s\n", error.what());
    return 1;
  }
}
