#include <cstdio>

#include "cli/commands.hpp"
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
  if (scene.column) {
    throw files::bad_input(options.scene.string(),
                           "LAMMPS decks are written for periodic beds only; this scene has a "
                           "container");
  }
  std::string name = options.scene.filename().string();
  for (const auto& setting : options.set) name += " --set " + setting;
  const std::string deck = lammps_deck(scene, name);
  if (options.output) {
    files::write_text(*options.output, deck);
  } else {
    std::fputs(deck.c_str(), stdout);
  }
  return 0;
}

}  // namespace shakebed::cli
