#include "figures/figure.hpp"

#include <cstdio>

#include "cli/commands.hpp"
#include "files/error.hpp"

namespace shakebed::cli {
namespace {

/// "canonical=path/to/canonical.csv": the name under which the specification knows the table.
std::pair<std::string, std::filesystem::path> named_table(const std::string& word) {
  const auto equals = word.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == word.size()) {
    throw files::bad_input("--table " + word,
                           "expected NAME=FILE, where the specification's 'from' says NAME");
  }
  return {word.substr(0, equals), word.substr(equals + 1)};
}

}  // namespace

int figure_command(const FigureOptions& options) {
  const auto specification = figures::read_specification(options.specification);
  if (specification.id != options.id) {
    throw files::bad_input(options.specification.string(),
                           "describes '" + specification.id + "', not '" + options.id + "'");
  }
  figures::Tables tables;
  for (const auto& word : options.tables) {
    const auto [name, file] = named_table(word.string());
    tables[name] = files::CsvTable::read(file);
  }
  for (const auto& file : figures::make_figure(specification, tables, options.output_folder)) {
    std::printf("%s\n", file.c_str());
  }
  return 0;
}

}  // namespace shakebed::cli
