#include "figures/claims.hpp"

#include <cstdio>

#include "cli/commands.hpp"

namespace shakebed::cli {

int claims_command(const ClaimsOptions& options) {
  const auto manifest = figures::read_manifest(options.manifest);
  const figures::PipelineTables tables(options.tables);
  std::vector<std::string> origins{"shipped"};
  for (const char* computed : {"quick", "standard", "paper"}) {
    if (tables.any(computed)) origins.emplace_back(computed);
  }
  const auto judged = figures::judge_claims(manifest, tables, origins);
  std::fputs(figures::claims_text(judged).c_str(), stdout);
  if (options.csv) figures::claims_table(judged).write(*options.csv);
  if (options.record) {
    figures::recorded_verdicts(judged).write(*options.record);
  } else if (options.recorded) {
    const auto changes = figures::changes_since(files::CsvTable::read(*options.recorded), judged);
    for (const auto& change : changes) std::printf("changed: %s\n", change.c_str());
  }
  return 0;
}

}  // namespace shakebed::cli
