#include "tests/oracle/lammps.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "cli/lammps_column_deck.hpp"
#include "cli/lammps_deck.hpp"
#include "files/atomic_file.hpp"

namespace shakebed::tests {
namespace {

namespace fs = std::filesystem;

/// A folder that goes with the object.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string pattern = (fs::temp_directory_path() / "shakebed-oracle-XXXXXX").string();
    if (!::mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder: " + pattern);
    path_ = pattern;
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string last_words(const fs::path& log) {
  const std::string text = fs::exists(log) ? files::read_text(log) : "";
  constexpr std::size_t most = 600;
  return text.size() <= most ? text : text.substr(text.size() - most);
}

CycleAverages read_averages(const fs::path& file) {
  std::ifstream in(file);
  std::vector<std::string> names;
  CycleAverages averages;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    if (line.starts_with('#')) {  // the last comment line names the columns
      std::string hash;
      words >> hash;
      names.assign(std::istream_iterator<std::string>(words), {});
      continue;
    }
    for (const auto& name : names) {
      double value = 0;
      if (!(words >> value)) throw std::runtime_error("not a line of averages: " + line);
      averages[name].push_back(value);
    }
  }
  return averages;
}

CycleAverages run_deck(const std::string& deck, const std::string& written) {
  const ScratchFolder scratch;
  files::write_text(scratch.path() / "deck.in", deck);
  const std::string command = "cd '" + scratch.path().string() +
                              "' && OMP_NUM_THREADS=1 lmp -in deck.in -nocite -log none "
                              "> screen.txt 2>&1";
  if (std::system(command.c_str()) != 0) {
    throw std::runtime_error("lmp failed:\n" + last_words(scratch.path() / "screen.txt"));
  }
  return read_averages(scratch.path() / written);
}

}  // namespace

bool lammps_is_here() {
  return std::system(
             "command -v lmp >/dev/null 2>&1 && lmp -h 2>/dev/null | "
             "grep -q gran/hooke") == 0;
}

CycleAverages run_lammps(const simulator::Scene& scene, std::uint64_t seed) {
  simulator::Scene seeded = scene;
  seeded.seed = seed;
  auto averages = run_deck(cli::lammps_deck(seeded, "oracle test"), "lammps_averages.txt");
  const auto wanted = static_cast<std::size_t>(scene.protocol.cycles.value_or(0));
  if (averages["T_z"].size() != wanted) {
    throw std::runtime_error("lmp wrote " + std::to_string(averages["T_z"].size()) +
                             " cycles, not " + std::to_string(wanted));
  }
  return averages;
}

CycleAverages run_lammps_column(const simulator::Scene& scene, std::uint64_t seed) {
  simulator::Scene seeded = scene;
  seeded.seed = seed;
  return run_deck(cli::lammps_column_deck(seeded, "oracle test"), "lammps_column.txt");
}

}  // namespace shakebed::tests
