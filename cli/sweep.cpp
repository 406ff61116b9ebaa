#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "cli/commands.hpp"
#include "files/error.hpp"
#include "simulator/simulate.hpp"
#include "sweeps/collect.hpp"
#include "sweeps/column_table.hpp"
#include "sweeps/ensemble.hpp"
#include "sweeps/grid.hpp"
#include "sweeps/progress.hpp"
#include "sweeps/stop_signals.hpp"
#include "sweeps/store/cache.hpp"

namespace shakebed::cli {
namespace {

using sweeps::store::Cache;

std::string name_of(const sweeps::Grid& grid) { return grid.id + " (" + grid.profile + ")"; }

void say_problems(const std::vector<std::string>& problems, const char* consequence) {
  for (const auto& problem : problems) {
    std::fprintf(stderr, "shakebed: warning: %s; %s\n", problem.c_str(), consequence);
  }
}

/// A failed bed is named with its point and its scene, so that it can be run alone.
void say_failures(const sweeps::Grid& grid, const std::vector<sweeps::Run>& runs,
                  const std::vector<sweeps::RunFailure>& failures) {
  for (const auto& failure : failures) {
    const sweeps::Run& run = runs[failure.run];
    std::fprintf(stderr, "shakebed: error: %s, replicate %d: %s\n  its scene:\n%s",
                 grid.describe(grid.points[run.point]).c_str(), run.replicate,
                 failure.message.c_str(), run.identity.canonical_scene.c_str());
  }
}

}  // namespace

int sweep_run_command(const SweepOptions& options) {
  const sweeps::Grid grid = sweeps::read_grid(options.sweep, options.profile);
  const Cache cache(Cache::place(options.cache));
  const std::vector<sweeps::Run> runs = sweeps::runs_of(grid);
  sweeps::Progress progress(std::cerr, ::isatty(STDERR_FILENO) != 0, name_of(grid));

  const sweeps::StopSignals signals;
  const auto report = sweeps::run_ensemble(runs, cache, simulator::simulate,
                                           {options.jobs, sweeps::StopSignals::raised, &progress});
  say_problems(report.made_again, "it was made again");
  say_failures(grid, runs, report.failures);
  std::printf("%s: %zu runs: %zu cached, %zu simulated, %zu failed\n", name_of(grid).c_str(),
              runs.size(), report.cached, report.finished, report.failures.size());
  if (report.interrupted) throw files::Interrupted();
  return report.failures.empty() ? 0 : 1;
}

int sweep_status_command(const SweepOptions& options) {
  const sweeps::Grid grid = sweeps::read_grid(options.sweep, options.profile);
  const Cache cache(Cache::place(options.cache));
  const sweeps::Status status = sweeps::status_of(grid, cache);
  std::printf("%s: %zu points, %zu runs: %zu cached, %zu missing", name_of(grid).c_str(),
              grid.points.size(), status.cached + status.missing, status.cached, status.missing);
  if (status.failed > 0) std::printf(" (%zu failed when last tried)", status.failed);
  if (status.missing > 0) {
    std::printf(", about %s of one core to go",
                sweeps::clock_text(status.predicted_cpu_seconds).c_str());
  }
  std::printf("\ncached runs took %s of one core\n",
              sweeps::clock_text(status.spent_cpu_seconds).c_str());
  std::printf("cache: %s\n", cache.folder().c_str());
  for (const auto& failure : status.failures) std::printf("failed: %s\n", failure.c_str());
  say_problems(status.problems, "it will be made again");
  return 0;
}

namespace {

/// Says what is missing of a table and writes it.
int publish(const sweeps::Grid& grid, const Cache& cache, const sweeps::Collected& collected,
            const SweepOptions& options) {
  say_problems(collected.problems, "it is left out; `shakebed sweep run` makes it again");
  if (collected.runs_present == 0) {
    throw files::failed(options.sweep.string(),
                        "none of its " + std::to_string(collected.runs_missing) + " runs is in " +
                            cache.folder().string() + "; do `shakebed sweep run` first");
  }
  if (collected.runs_missing > 0) {
    std::fprintf(stderr, "shakebed: warning: %s: %zu of %zu runs are missing\n",
                 name_of(grid).c_str(), collected.runs_missing,
                 collected.runs_missing + collected.runs_present);
  }
  if (options.csv) {
    collected.table.write(*options.csv);
  } else {
    std::fputs(collected.table.to_text().c_str(), stdout);
  }
  return 0;
}

}  // namespace

int sweep_collect_command(const SweepOptions& options) {
  const sweeps::Grid grid = sweeps::read_grid(options.sweep, options.profile);
  const Cache cache(Cache::place(options.cache));
  const auto with = options.profiles ? sweeps::With::averages_and_profiles : sweeps::With::averages;
  const sweeps::Collected collected = sweeps::collect(grid, cache, with);
  if (options.profiles && collected.runs_present > 0) collected.profiles.write(*options.profiles);
  return publish(grid, cache, collected, options);
}

int sweep_snapshots_command(const SweepOptions& options) {
  const sweeps::Grid grid = sweeps::read_grid(options.sweep, options.profile);
  const Cache cache(Cache::place(options.cache));
  return publish(grid, cache, sweeps::collect_snapshots(grid, cache), options);
}

int sweep_series_command(const SweepOptions& options) {
  const sweeps::Grid grid = sweeps::read_grid(options.sweep, options.profile);
  const Cache cache(Cache::place(options.cache));
  return publish(grid, cache,
                 sweeps::collect_series(grid, cache, {options.phases, options.from, options.to}),
                 options);
}

}  // namespace shakebed::cli
