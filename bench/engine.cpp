#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "bench/baseline/bed.hpp"
#include "bench/lammps_time.hpp"
#include "files/build_info.hpp"
#include "files/csv.hpp"
#include "files/error.hpp"
#include "simulator/contact/parameters.hpp"
#include "simulator/scene/read_scene.hpp"
#include "simulator/simulate.hpp"

// Engines side by side on Bhateja's rough beds, 100 grains in three dimensions or 40 in two:
// e = 0.9, mu = 0.4, c_t = c_n, dt = t_c/50, k_n = clamp(4e4 W, 1e5, 1e6), observables sampled as
// in production. The contestants take turns; what is compared is CPU time per grain and step of the
// measured cycles (an engine that skips steps is charged for those it stands for), in each turn
// over that of the uniform engine, and the median over turns.
namespace {

using namespace shakebed;

struct Options {
  int turns = 5;
  double scale = 1;  ///< of the cycles measured
  std::string deck_writer = "shakebed";
  std::vector<int> dimensions = {3, 2};
  std::vector<double> W;  ///< empty: those of each dimension's table
};

/// One bed of the table.
struct Bed {
  int dimension;
  double W;
  std::uint64_t seed;
};

struct Timed {
  double nanoseconds;  ///< CPU time per grain and step
  double thousand;     ///< CPU seconds per 1000 cycles
  double collision;    ///< CPU microseconds per collision
};

struct Contestant {
  std::string name;
  std::function<Timed(const Bed&, long cycles)> run;
  std::vector<Timed> turns = {};
};

/// `collisions` over the same cycles; 0: unknown.
Timed timed(double cpu_seconds, double collisions, long cycles, const simulator::Scene& scene) {
  const auto steps = simulator::bind_parameters(scene).steps_per_cycle;
  const double grain_steps = static_cast<double>(cycles) * static_cast<double>(steps) *
                             static_cast<double>(scene.grains.count);
  return {1e9 * cpu_seconds / grain_steps, 1000 * cpu_seconds / static_cast<double>(cycles),
          collisions > 0 ? 1e6 * cpu_seconds / collisions : std::nan("")};
}

Timed timed(const simulator::Record& record, long cycles, const simulator::Scene& scene) {
  double collisions = 0;
  for (const auto& scalar : record.scalars) {
    if (scalar.name == "collisions") collisions = scalar.value;
  }
  return timed(record.timing.cpu_seconds_measuring, collisions, cycles, scene);
}

std::vector<std::string> settings(const Bed& bed, long cycles) {
  using files::number_text;
  return {"dimension=" + std::to_string(bed.dimension),
          bed.dimension == 2 ? "cell=[10]" : "cell=[5,5]",
          "base.drive.W=" + number_text(bed.W),
          "contact.stiffness=" + number_text(std::clamp(4e4 * bed.W, 1e5, 1e6)),
          "protocol.measure.cycles=" + std::to_string(cycles),
          "seed=" + std::to_string(bed.seed)};
}

simulator::Scene scene_of(const Bed& bed, long cycles) {
  std::vector<simulator::Override> overrides;
  for (const auto& setting : settings(bed, cycles)) {
    const auto equals = setting.find('=');
    overrides.push_back({setting.substr(0, equals), setting.substr(equals + 1)});
  }
  return simulator::read_scene(SHAKEBED_ROUGH_BED, overrides);
}

Timed ours(const simulator::Scene& scene) {
  return timed(simulator::simulate(scene), *scene.protocol.cycles, scene);
}

Timed plain(const Bed& bed, long cycles) {
  const auto scene = scene_of(bed, cycles);
  const auto record = baseline::simulate(scene);
  return timed(record, cycles, scene);
}

Timed uniform(const Bed& bed, long cycles) {
  auto scene = scene_of(bed, cycles);
  scene.protocol.engine = simulator::Engine::uniform;
  return ours(scene);
}

Timed events(const Bed& bed, long cycles, simulator::ContactOperator contacts) {
  auto scene = scene_of(bed, 4 * cycles);  // they are the fast ones
  scene.protocol.engine = simulator::Engine::events;
  scene.protocol.contacts = contacts;
  return ours(scene);
}

std::string output_of(const std::string& command) {
  std::string text;
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) throw files::failed(command, "could not be started");
  char buffer[4096];
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) text.append(buffer, n);
  if (pclose(pipe) != 0) throw files::failed(command, "failed");
  return text;
}

Timed lammps(const Bed& bed, long cycles, const std::string& deck_writer) {
  cycles = std::max(2L, cycles / 8);  // it is the slow one
  const auto scene = scene_of(bed, cycles);
  std::string command = "'" + deck_writer + "' export '" SHAKEBED_ROUGH_BED "'";
  for (const auto& setting : settings(bed, cycles)) command += " --set '" + setting + "'";
  const long steps = simulator::bind_parameters(scene).steps_per_cycle;
  return timed(bench::lammps_cpu_seconds(output_of(command), steps), 0, cycles, scene);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

std::vector<double> each(const std::vector<Timed>& turns, double Timed::*member) {
  std::vector<double> values;
  for (const auto& turn : turns) values.push_back(turn.*member);
  return values;
}

void print_row(const Bed& bed, const Contestant& baseline, const Contestant& contestant) {
  std::vector<double> ratios;
  for (std::size_t t = 0; t < contestant.turns.size(); ++t) {
    ratios.push_back(baseline.turns[t].nanoseconds / contestant.turns[t].nanoseconds);
  }
  const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
  std::printf("%dD %7.4g  %-10s %9.3g %11.4g %11.3g %9.3g   (%.3g ... %.3g)\n", bed.dimension,
              bed.W, contestant.name.c_str(), median(each(contestant.turns, &Timed::nanoseconds)),
              median(each(contestant.turns, &Timed::thousand)),
              median(each(contestant.turns, &Timed::collision)), median(ratios), *least, *most);
  std::fflush(stdout);
}

/// Enough cycles that a turn of the uniform engine takes about a second.
long cycles_at(double W, double scale) {
  const double wanted = W < 3 ? 20 : W < 10 ? 60 : 150;
  return std::max(8L, static_cast<long>(wanted * scale));
}

void compare(Bed bed, const Options& options, std::vector<Contestant> contestants) {
  const long cycles = cycles_at(bed.W, options.scale);
  for (int turn = 0; turn < options.turns; ++turn) {
    bed.seed = static_cast<std::uint64_t>(turn) + 1;
    for (auto& contestant : contestants) contestant.turns.push_back(contestant.run(bed, cycles));
  }
  for (const auto& contestant : contestants) print_row(bed, contestants.front(), contestant);
}

std::vector<double> table_of(int dimension) {
  if (dimension == 2) return {22.36, 89.43};
  return {0.9, 1.5, 2, 5.6, 22.36, 89.43};
}

std::vector<Contestant> contestants_for(const Options& options) {
  using simulator::ContactOperator;
  const auto with = [](ContactOperator contacts) {
    return [contacts](const Bed& bed, long cycles) { return events(bed, cycles, contacts); };
  };
  std::vector<Contestant> all = {{"plain", plain},
                                 {"uniform", uniform},
                                 {"fine", with(ContactOperator::fine)},
                                 {"closed", with(ContactOperator::closed)}};
  if (bench::lammps_is_here()) {
    all.push_back({"LAMMPS", [&options](const Bed& bed, long cycles) {
                     return lammps(bed, cycles, options.deck_writer);
                   }});
  } else {
    std::printf("LAMMPS is left out: no lmp on PATH (make deps-oracle installs it).\n");
  }
  return all;
}

[[noreturn]] void usage(const std::string& fault) {
  throw files::bad_input(fault,
                         "usage: engine [--turns N] [--scale X] [--dimension 2|3] "
                         "[--shakebed PROGRAM] [W ...]");
}

Options read_options(int argc, char** argv) {
  Options options;
  const auto number = [](const std::string& word) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (word.empty() || *end != '\0' || !(value > 0)) usage(word);
    return value;
  };
  for (int a = 1; a < argc; ++a) {
    const std::string word = argv[a];
    if (!word.starts_with("--")) {
      options.W.push_back(number(word));
      continue;
    }
    if (a + 1 == argc) usage(word);
    const std::string value = argv[++a];
    if (word == "--turns") {
      options.turns = std::max(1, static_cast<int>(number(value)));
    } else if (word == "--scale") {
      options.scale = number(value);
    } else if (word == "--dimension") {
      if (value != "2" && value != "3") usage(value);
      options.dimensions = {value == "2" ? 2 : 3};
    } else if (word == "--shakebed") {
      options.deck_writer = value;
    } else {
      usage(word);
    }
  }
  return options;
}

void print_head(const Options& options) {
  std::printf(
      "Rough beds, 100 grains (3D) or 40 (2D), dt = t_c/50, k_n = clamp(4e4 W, 1e5, 1e6) m g/d; %d "
      "turns.\n",
      options.turns);
  std::printf(
      "Ours: %s, for %s.\n"
      "LAMMPS: the package of this machine. Debian's is built for any x86-64; one built for this\n"
      "machine would be faster.\n\n",
      std::string(files::compiler_flags()).c_str(), std::string(files::machine()).c_str());
  std::printf("   %7s  %-10s %9s %11s %11s %9s   %s\n", "W", "", "ns/grain/", "s per 1000",
              "us per", "times as", "(least ... most");
  std::printf("   %7s  %-10s %9s %11s %11s %9s   %s\n", "", "", "step", "cycles", "collision",
              "fast", " of the turns)");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Options options = read_options(argc, argv);
    const auto contestants = contestants_for(options);
    print_head(options);
    for (const int dimension : options.dimensions) {
      for (const double W : options.W.empty() ? table_of(dimension) : options.W) {
        compare({dimension, W, 1}, options, contestants);
      }
    }
    return 0;
  } catch (const files::Error& error) {
    std::fprintf(stderr, "engine: %s\n", error.what());
    return error.kind() == files::Error::Kind::bad_input ? 2 : 1;
  }
}
