#include <cstdio>

#include "cli/commands.hpp"
#include "cli/lammps_column_deck.hpp"
#include "cli/lammps_deck.hpp"
#include "cli/overrides.hpp"
#include "files/atomic_file.hpp"
#include "simulator/scene/read_scene.hpp"

namespace shakebed::cli {

int export_command(const ExportOptions& options) {
  if (options.format != "lammps-deck") {
    throw files::bad_input("--format " + options.format,
                           "expected lammps-deck, the one format there is");
  }
  const auto scene = simulator::read_scene(options.scene, parse_overrides(options.set));
  std::string name = options.scene.filename().string();
  for (const auto& setting : options.set) name += " --set " + setting;
  const std::string deck =
      scene.column ? lammps_column_deck(scene, name) : lammps_deck(scene, name);
  if (options.output) {
    files::write_text(*options.output, deck);
  } else {
    std::fputs(deck.c_str(), stdout);
  }
  return 0;
}

}  // namespace shakebed::cli
