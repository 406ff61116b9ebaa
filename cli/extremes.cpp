#include "sweeps/extremes.hpp"

#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "cli/commands.hpp"
#include "files/error.hpp"
#include "simulator/simulate.hpp"
#include "sweeps/ensemble.hpp"
#include "sweeps/progress.hpp"
#include "sweeps/stop_signals.hpp"

namespace shakebed::cli {

int extremes_command(const ExtremesOptions& options) {
  auto list = sweeps::read_extremes(options.list);
  const sweeps::store::Cache cache(sweeps::store::Cache::place(options.cache));
  const auto runs = sweeps::runs_of(list);
  sweeps::Progress progress(std::cerr, ::isatty(STDERR_FILENO) != 0, list.id);
  const sweeps::StopSignals signals;
  const auto report = sweeps::run_ensemble(runs, cache, simulator::simulate,
                                           {options.jobs, sweeps::StopSignals::raised, &progress});
  if (report.interrupted) throw files::Interrupted();

  std::vector<std::optional<simulator::Record>> records(list.cases.size());
  for (const auto& run : runs) {
    if (auto found = cache.find(run.identity); found.run) {
      records[run.point] = std::move(found.run->record);
    } else if (const auto failure = cache.failure_of(run.identity.key)) {
      list.cases[run.point].failure = failure->substr(0, failure->find('\n'));
    }
  }
  const auto table = sweeps::extremes_table(list, records);
  if (options.csv) table.write(*options.csv);
  int unsaid = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto text = [&](const char* name) { return table.text(row, table.column(name)); };
    std::printf("%-14s %-34s %-22s %s\n", text("group").c_str(), text("case").c_str(),
                text("verdict").c_str(), text("says").c_str());
    unsaid += text("verdict") == "wrong, UNSAID" || text("verdict") == "failed";
  }
  return unsaid == 0 ? 0 : 1;
}

}  // namespace shakebed::cli
