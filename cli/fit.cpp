#include <cstdio>

#include "cli/commands.hpp"
#include "files/csv.hpp"
#include "fitting/fit_file.hpp"
#include "fitting/tables.hpp"

namespace shakebed::cli {

int fit_command(const FitOptions& options) {
  const auto file = fitting::read_fit_file(options.fit);
  const auto path = options.data.value_or(file.data);
  if (path.empty()) {
    throw files::bad_input(options.fit.string(),
                           "names no `data`: give the collected table with --data");
  }
  const auto data = files::CsvTable::read(path);
  const auto report = fitting::run_fits(file, data);
  const auto tables = fitting::tables(file, report, data);
  if (options.csv) {
    for (const auto& [name, table] : tables) {
      table.write(fitting::table_path(*options.csv, name));
    }
  }
  const std::string text = fitting::readable(report);
  std::fputs(text.c_str(), stdout);
  return 0;
}

}  // namespace shakebed::cli
