#include "figures/gnuplot.hpp"

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <system_error>

#include "figures/process.hpp"
#include "files/atomic_file.hpp"
#include "files/error.hpp"

namespace shakebed::figures {
namespace {

namespace fs = std::filesystem;

// gnuplot's single-quoted strings know one escape: a doubled quote.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

std::string size_text(std::pair<int, int> size, int scale) {
  return std::to_string(size.first * scale) + "," + std::to_string(size.second * scale);
}

std::string svg_terminal(std::pair<int, int> size) {
  return "set terminal svg size " + size_text(size, 1) +
         " dynamic enhanced font 'DejaVu Sans,14' background '#ffffff'\n";
}

// Twice the pixels, so that the picture is sharp in print.
std::string png_terminal(std::pair<int, int> size) {
  return "set terminal pngcairo size " + size_text(size, 2) +
         " enhanced font 'DejaVu Sans,14' fontscale 2 linewidth 2 pointscale 2\n";
}

std::string preamble(const fs::path& script, const std::vector<ScriptTable>& tables) {
  std::string text = "set loadpath " + quoted(script.parent_path().string()) + " " +
                     quoted((script.parent_path().parent_path()).string()) + "\n" +
                     "set datafile separator ','\nset datafile missing NaN\n" +
                     "set datafile columnheaders\n";
  for (const auto& table : tables) {
    text += table.name + " = " + quoted(table.file.string()) + "\n";
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      text += table.name + "_" + table.columns[i].name + " = " + std::to_string(i + 1) + "\n";
    }
  }
  return text;
}

std::string program() {
  const char* set = std::getenv("SHAKEBED_GNUPLOT");
  return set != nullptr && *set != '\0' ? set : "gnuplot";
}

/// Scripts draw one series for each state of a point, and most figures have no point that is at
/// rest or not stationary: gnuplot's warning of that is not worth a reader's time.
std::string without_empty_series(const std::string& text) {
  std::istringstream lines(text);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("Skipping data file with no valid points") == std::string::npos) {
      kept += line + "\n";
    }
  }
  return kept.find_first_not_of(" \n") == std::string::npos ? "" : kept;
}

void run_gnuplot(const fs::path& commands, const fs::path& script) {
  ProcessResult result;
  try {
    result = run_process({program(), "-d", commands.string()});
  } catch (const std::system_error& error) {
    throw files::failed(program(), "cannot be started (" + error.code().message() +
                                       "); install gnuplot (make deps) or name the program in "
                                       "SHAKEBED_GNUPLOT");
  }
  if (result.exit_code != 0) {
    throw files::failed(script.string(), "gnuplot stopped with exit code " +
                                             std::to_string(result.exit_code) + ":\n" +
                                             result.error_text);
  }
  std::fputs(without_empty_series(result.error_text).c_str(), stderr);
}

/// A file that is gone when the scope is left.
struct Scratch {
  fs::path path;
  ~Scratch() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
};

void draw_as(const std::string& terminal, const fs::path& target, const fs::path& script,
             const std::string& variables) {
  const Scratch picture{files::temporary_beside(target)};
  const Scratch commands{files::temporary_beside(fs::path(target).concat(".gp"))};
  files::write_text(commands.path, variables + terminal + "set output " +
                                       quoted(picture.path.string()) + "\nload " +
                                       quoted(script.string()) + "\nunset output\n");
  run_gnuplot(commands.path, script);
  if (!fs::exists(picture.path) || fs::file_size(picture.path) == 0) {
    throw files::failed(script.string(), "gnuplot succeeded but drew nothing");
  }
  files::publish(picture.path, target);
}

}  // namespace

void draw(const fs::path& script, const std::vector<ScriptTable>& tables, std::pair<int, int> size,
          const fs::path& stem) {
  const auto variables = preamble(script, tables);
  draw_as(svg_terminal(size), fs::path(stem).concat(".svg"), script, variables);
  draw_as(png_terminal(size), fs::path(stem).concat(".png"), script, variables);
}

}  // namespace shakebed::figures
