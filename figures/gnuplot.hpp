#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "files/csv.hpp"

namespace shakebed::figures {

/// A CSV under the name by which a script knows it. For a table `points` with a column `W` the
/// script finds `points` (the file) and `points_W` (the column's number), so that a misspelt
/// column stops gnuplot instead of drawing nothing.
struct ScriptTable {
  std::string name;
  std::filesystem::path file;
  std::vector<files::CsvColumn> columns;
};

/// Draws `script` twice, as <stem>.svg and <stem>.png, each written beside its final name and
/// renamed when gnuplot succeeded. `size` is in pixels. The SVG's bytes depend on the script, the
/// data and gnuplot's version alone. Throws Error(failed) with gnuplot's own words when it stops.
/// The program is SHAKEBED_GNUPLOT, else `gnuplot` on PATH.
void draw(const std::filesystem::path& script, const std::vector<ScriptTable>& tables,
          std::pair<int, int> size, const std::filesystem::path& stem);

}  // namespace shakebed::figures
