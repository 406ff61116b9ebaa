#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "files/atomic_file.hpp"
#include "tests/oracle/column_deck.hpp"

namespace shakebed::tests {

inline simulator::SizedGrains read_last_frame(const std::filesystem::path& dump,
                                              const simulator::SizedGrains& start) {
  simulator::SizedGrains end = start;
  std::ifstream out(dump);
  std::size_t next = start.count();
  for (std::string line; std::getline(out, line);) {
    if (line.starts_with("ITEM: ATOMS")) {
      next = 0;  // the last frame wins
      continue;
    }
    if (next >= start.count()) continue;
    std::istringstream in(line);
    std::size_t id = 0;
    in >> id;
    for (auto* columns : {&end.position, &end.velocity, &end.spin}) {
      for (auto& column : *columns) in >> column[id - 1];
    }
    ++next;
  }
  return end;
}

/// Where LAMMPS takes a bed without contact memory in some steps of gran/hooke/history.
template <class Physics>
simulator::SizedGrains run_lammps_bed(const Physics& physics, const simulator::SpringKind& grain,
                                      const simulator::SpringKind& wall,
                                      const simulator::SizedGrains& start, long steps) {
  namespace fs = std::filesystem;
  std::string pattern = (fs::temp_directory_path() / "shakebed-column-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no folder " + pattern);
  const fs::path folder = pattern;
  write_data(folder / "bed.data", start);
  {
    std::ofstream deck(folder / "deck.in");
    write_deck_head(deck, physics, grain, wall, physics.cylinder.radius, 0.3);
    deck << "dump d all custom " << steps
         << " out.txt id x y z vx vy vz omegax omegay omegaz\n"
            "dump_modify d sort id format float %.17g\nthermo "
         << steps << "\nrun " << steps << '\n';
  }
  const std::string command = "cd '" + pattern +
                              "' && OMP_NUM_THREADS=1 lmp -in deck.in -nocite -log none "
                              "> screen.txt 2>&1";
  if (std::system(command.c_str()) != 0) {
    throw std::runtime_error("lmp failed:\n" + shakebed::files::read_text(folder / "screen.txt"));
  }
  const auto end = read_last_frame(folder / "out.txt", start);
  fs::remove_all(folder);
  return end;
}

}  // namespace shakebed::tests
