#include "sweeps/trade.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <iostream>

#include "cli/commands.hpp"
#include "cli/overrides.hpp"
#include "files/error.hpp"
#include "fitting/trade/alpha_bias.hpp"
#include "fitting/trade/bias_law.hpp"
#include "fitting/trade/promises.hpp"
#include "simulator/simulate.hpp"
#include "sweeps/collect.hpp"
#include "sweeps/progress.hpp"
#include "sweeps/stop_signals.hpp"
#include "sweeps/trade_column.hpp"

namespace shakebed::cli {
namespace {

using sweeps::Grid;
using sweeps::StopSignals;

simulator::Record not_timed() {
  simulator::Record record;
  record.timing.cpu_seconds_measuring = std::nan("");
  return record;
}

bool in_container(const Grid& grid) { return grid.points.front().scene.column.has_value(); }

/// The beds of one scene, then their timing.
files::CsvTable study(const std::filesystem::path& scene, const Grid& grid,
                      const sweeps::store::Cache& cache, const TradeOptions& options,
                      std::vector<std::string>& provenance) {
  sweeps::Progress progress(std::cerr, ::isatty(STDERR_FILENO) != 0, "trade " + grid.id);
  const auto runs = sweeps::runs_of(grid);
  const auto report = sweeps::run_ensemble(runs, cache, simulator::simulate,
                                           {options.jobs, StopSignals::raised, &progress});
  if (report.interrupted) throw files::Interrupted();
  for (const auto& failure : report.failures) {  // its row says so; the others are no worse for it
    std::fprintf(stderr, "shakebed: warning: %s: %s: %s\n", scene.c_str(),
                 grid.describe(grid.points[runs[failure.run].point]).c_str(),
                 failure.message.c_str());
  }
  const auto collected = sweeps::collect(grid, cache);
  provenance = collected.table.provenance;
  std::vector<simulator::Scene> scenes;
  for (const auto& point : grid.points) scenes.push_back(point.scene);
  const simulator::RunControl control{StopSignals::raised, {}, nullptr};
  const auto timed = [&](const simulator::Scene& one, const simulator::RunControl&) {
    try {
      return simulator::simulate(one, control);
    } catch (const files::Error&) {
      return not_timed();
    }
  };
  const auto seconds = sweeps::time_in_turns(scenes, options.rounds, timed);
  if (in_container(grid)) return sweeps::column_trade_table(grid.id, grid, cache, seconds);
  return sweeps::trade_table(grid.id, grid, collected.table, seconds);
}

struct Shown {
  const char* name;
  const char* heading;
};

/// Setting, first quantity, biases of two, cost.
void print(const files::CsvTable& table, const Shown& first, const Shown& second) {
  std::printf("%-18s %-11s %6s %10s %19s %19s %12s %12s\n", "scene", "axis", "value", first.heading,
              ("bias of " + std::string(first.heading) + " [%]").c_str(),
              ("bias of " + std::string(second.heading) + " [%]").c_str(), "s/1000 cyc",
              "s for 1 %");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto number = [&](const std::string& name) {
      return table.number(row, table.column(name));
    };
    const std::string a = first.name, b = second.name;
    std::printf("%-18s %-11s %6s %10.4g %9.2f +- %-6.2f %9.2f +- %-6.2f %12.3g %12.3g\n",
                table.text(row, 0).c_str(), table.text(row, 1).c_str(), table.text(row, 2).c_str(),
                number(a), number(a + "_bias"), number(a + "_bias_se"), number(b + "_bias"),
                number(b + "_bias_se"), number("seconds_per_1000_cycles"),
                number("seconds_for_1_percent"));
  }
}

}  // namespace

namespace {

/// From a finished table: the laws of bias, and the settings that `accuracy` chooses from.
int bounds_command(const TradeOptions& options) {
  const auto trade = files::CsvTable::read(*options.bounds);
  const auto table = fitting::trade::accuracy_table(trade);
  auto laws = fitting::trade::bias_laws(trade, "dt closed");
  for (const char* axis : {"dt stepped", "k_n"}) {
    for (auto& law : fitting::trade::bias_laws(trade, axis)) laws.push_back(std::move(law));
  }
  for (const auto& law : laws) {
    std::printf("%-18s %-11s T_z = T_0 (1 + c x), c = %8.4f +- %.4f, chi^2/dof = %.1f/%zu\n",
                law.scene.c_str(), law.axis.c_str(), law.coefficient, law.error, law.chi_squared,
                law.degrees_of_freedom);
  }
  if (options.laws) fitting::trade::law_table(laws).write(*options.laws);
  if (options.alpha) {
    fitting::trade::alpha_table(fitting::trade::alpha_biases(trade)).write(*options.alpha);
  }
  if (options.csv) {
    table.write(*options.csv);
  } else {
    std::fputs(table.to_text().c_str(), stdout);
  }
  return 0;
}

int verify_command(const TradeOptions& options) {
  const auto kept = fitting::trade::kept_promises(files::CsvTable::read(*options.verify),
                                                  files::CsvTable::read(*options.references));
  const auto table = fitting::trade::promises_table(kept);
  for (const auto& one : kept) {
    std::printf("%-16s %-5s kept %3zu of %3zu, mean error %6.2f %%, largest %5.2f %%, P = %.3g\n",
                one.scene.c_str(), one.asked.c_str(), one.kept, one.runs, 100 * one.mean_error,
                100 * one.largest_error, one.chance);
  }
  if (options.csv) table.write(*options.csv);
  return 0;
}

}  // namespace

int trade_command(const TradeOptions& options) {
  if (options.bounds) return bounds_command(options);
  if (options.verify) return verify_command(options);
  const auto profile = sweeps::trade_profile(options.profile);
  const auto overrides = parse_overrides(options.set);
  std::vector<Grid> grids;
  for (const auto& scene : options.scenes) {
    grids.push_back(sweeps::trade_grid(scene, overrides, profile));
    if (!options.axes.empty()) sweeps::keep_axes(grids.back(), options.axes);
    if (in_container(grids.back()) == in_container(grids.front())) continue;
    throw files::bad_input(scene.string(),
                           "beds in a container are measured by other quantities than periodic "
                           "ones; study them apart");
  }
  const sweeps::store::Cache cache(sweeps::store::Cache::place(options.cache));
  const StopSignals signals;
  files::CsvTable all;
  for (std::size_t k = 0; k < grids.size(); ++k) {
    std::vector<std::string> provenance;
    const auto table = study(options.scenes[k], grids[k], cache, options, provenance);
    if (k == 0) all = files::CsvTable(table.columns());
    sweeps::append_rows(all, table);
    // The lines of the first scene stand for all: one program made them.
    if (k == 0) {
      for (const auto& line : provenance) {
        if (line.starts_with("physics") || line.starts_with("machine") ||
            line.starts_with("compiler") || line.starts_with("git") ||
            line.starts_with("profile")) {
          all.provenance.push_back(line);
        }
      }
    }
    if (options.csv) all.write(*options.csv);
  }
  if (in_container(grids.front())) {
    print(all, {"rise_rate", "rise rate"}, {"coordination", "Z"});
  } else {
    print(all, {"T_z", "T_z"}, {"h_cm", "h_cm"});
  }
  return 0;
}

}  // namespace shakebed::cli
