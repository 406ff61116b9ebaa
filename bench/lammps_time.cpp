#include "bench/lammps_time.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "files/atomic_file.hpp"
#include "files/error.hpp"

namespace shakebed::bench {
namespace {

namespace fs = std::filesystem;

std::string last_words(const std::string& text) {
  constexpr std::size_t most = 600;
  return text.size() <= most ? text : text.substr(text.size() - most);
}

}  // namespace

std::vector<double> cpu_seconds_of_runs(const std::string& screen) {
  std::vector<double> seconds;
  double loop = 0;
  std::istringstream lines(screen);
  for (std::string line; std::getline(lines, line);) {
    std::sscanf(line.c_str(), "Loop time of %lf on", &loop);
    double percent = 0;
    if (line.find("% CPU use") == std::string::npos) continue;
    if (std::sscanf(line.c_str(), "%lf%%", &percent) == 1 && loop > 0 && percent > 0) {
      seconds.push_back(loop * percent / 100);
    }
  }
  if (seconds.empty()) {
    throw files::failed("lmp", "wrote no loop time; it ended with:\n" + last_words(screen));
  }
  return seconds;
}

bool lammps_is_here() { return std::system("command -v lmp >/dev/null 2>&1") == 0; }

double lammps_cpu_seconds(const std::string& deck, long steps_per_cycle) {
  std::string pattern = (fs::temp_directory_path() / "shakebed-bench-XXXXXX").string();
  if (!::mkdtemp(pattern.data())) throw files::failed(pattern, "no temporary folder");
  const fs::path folder = pattern;
  files::write_text(folder / "deck.in", deck);
  const std::string command = "cd '" + folder.string() +
                              "' && OMP_NUM_THREADS=1 lmp -in deck.in -nocite -log none "
                              "-var steps_per_cycle " +
                              std::to_string(steps_per_cycle) + " > screen.txt 2>&1";
  const int status = std::system(command.c_str());
  const std::string screen = files::read_text(folder / "screen.txt");
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  if (status != 0) throw files::failed("lmp", "failed; it ended with:\n" + last_words(screen));
  return cpu_seconds_of_runs(screen).back();
}

}  // namespace shakebed::bench
