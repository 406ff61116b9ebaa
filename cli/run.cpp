#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/overrides.hpp"
#include "cli/run_json.hpp"
#include "files/atomic_file.hpp"
#include "simulator/scene/accuracy.hpp"
#include "simulator/scene/read_scene.hpp"
#include "simulator/simulate.hpp"
#include "sweeps/stop_signals.hpp"
#include "sweeps/store/bed_store.hpp"
#include "sweeps/store/cache.hpp"
#include "sweeps/store/run_file.hpp"
#include "sweeps/thread_team.hpp"

namespace shakebed::cli {
namespace {

double process_cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void print_summary(const simulator::Record& record) {
  for (const auto& q : record.quantities) {
    if (std::isnan(q.estimate.mean)) continue;
    std::printf("%-22s %12.6g +- %-10.2g %s\n", q.name.c_str(), q.estimate.mean,
                q.estimate.standard_error, q.unit.c_str());
  }
  for (const auto& s : record.scalars) {
    std::printf("%-22s %12.8g %13s %s\n", s.name.c_str(), s.value, "", s.unit.c_str());
  }
  std::printf("%-22s %s (%s)\n", "stationary", record.stationary ? "yes" : "no",
              record.stationary_reason.c_str());
}

/// What was promised, what was reached, and what of it is bias and what noise.
void say_accuracy(const simulator::ReachedAccuracy& reached) {
  if (reached.at_rest) {
    std::fprintf(stderr, "shakebed: accuracy: at rest, T_z/(m V_p^2) < 1e-6\n");
    return;
  }
  std::fprintf(
      stderr,
      "shakebed: accuracy: T_z to %.2g %% (bias at most %.2g %%, noise %.2g %%, together a "
      "95 %% bound); %.2g %% was asked for%s\n",
      100 * reached.reached(), 100 * reached.bias_bound, 100 * reached.noise, 100 * reached.asked,
      reached.met() ? "" : ": NOT met, raise measure.at_most");
}

}  // namespace

int run_command(const RunOptions& options) {
  const auto scene = simulator::read_scene(options.scene, parse_overrides(options.set));
  const sweeps::StopSignals stop_signals;

  simulator::RunControl control;
  const auto beds = sweeps::store::bed_store(sweeps::store::Cache::place(std::nullopt));
  control.store = &beds;
  auto team = sweeps::ThreadTeam::for_bed(scene, options.threads);
  control.crew = &team;
  control.stop_requested = sweeps::StopSignals::raised;
  if (isatty(STDERR_FILENO) != 0) {
    control.on_progress = [shown = -1](double fraction) mutable {
      const int percent = static_cast<int>(100 * fraction);
      if (percent == shown) return;
      shown = percent;
      std::fprintf(stderr, "\r%3d %%", percent);
    };
  }
  const auto record = simulator::simulate(scene, control);
  if (control.on_progress) std::fprintf(stderr, "\r     \r");

  if (options.output) {
    sweeps::store::write_run_file(*options.output, record,
                                  sweeps::store::provenance_of_this_program());
  }
  if (options.json) {
    auto json = run_json(record, process_cpu_seconds());
    if (const auto reached = simulator::reached_accuracy(scene, record)) {
      json["accuracy"] = accuracy_json(*reached);
    }
    const auto text = json.dump(2) + "\n";
    if (*options.json == "-") {
      std::fputs(text.c_str(), stdout);
    } else {
      files::write_text(*options.json, text);
    }
  }
  if (!options.json || *options.json != "-") print_summary(record);
  if (const auto reached = simulator::reached_accuracy(scene, record)) say_accuracy(*reached);
  for (const auto& warning : record.warnings) {
    std::fprintf(stderr, "shakebed: warning: %s\n", warning.c_str());
  }
  return 0;
}

}  // namespace shakebed::cli
