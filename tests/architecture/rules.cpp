#include "tests/architecture/rules.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

namespace shakebed::tests {

namespace {

bool starts_with_any(const std::string& text, const std::vector<std::string>& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](const std::string& prefix) { return text.starts_with(prefix); });
}

std::string lower_case(std::string text) {
  for (char& letter : text) letter = static_cast<char>(std::tolower(letter));
  return text;
}

bool is_standard(const std::string& header) {
  return header.find_first_of("./") == std::string::npos;
}

bool is_posix(const std::string& header) {
  static const std::vector<std::string> known = {"fcntl.h",  "glob.h",   "poll.h", "pthread.h",
                                                 "signal.h", "spawn.h",  "sys/",   "termios.h",
                                                 "time.h",   "unistd.h", "sched.h"};
  return starts_with_any(header, known);
}

const Room* room_of(const std::string& path) {
  const Room* best = nullptr;
  for (const Room& room : rooms()) {
    if (path.starts_with(room.folder) && (!best || room.folder.size() > best->folder.size())) {
      best = &room;
    }
  }
  return best;
}

struct Include {
  int line;
  bool quoted;
  std::string header;
};

std::vector<Include> includes_of(const Source& source) {
  static const std::regex directive(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> found;
  std::istringstream lines(source.text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::smatch match;
    if (std::regex_search(line, match, directive)) {
      found.push_back({number, match[1] == "\"", match[2]});
    }
  }
  return found;
}

/// Empty when the include keeps the rules.
std::string fault_of(const Include& include, const Source& source, const Room& room,
                     const std::vector<Source>& tree) {
  if (include.quoted) {
    const bool exists = std::any_of(tree.begin(), tree.end(), [&](const Source& other) {
      return other.path == include.header;
    });
    if (!exists) return "no such path from the root";
    if (!starts_with_any(include.header, room.ours)) return room.folder + " may not know it";
    return "";
  }
  for (const Sole& sole : soles()) {
    if (include.header.starts_with(sole.header) && !source.path.starts_with(sole.place)) {
      return "only " + sole.place + " may include it";
    }
  }
  const bool allowed = is_standard(include.header) ||
                       starts_with_any(include.header, room.packages) ||
                       (room.posix && is_posix(include.header));
  return allowed ? "" : "not among the libraries of " + room.folder;
}

}  // namespace

std::vector<Violation> include_violations(const std::vector<Source>& tree) {
  std::vector<Violation> violations;
  for (const Source& source : tree) {
    const Room* room = room_of(source.path);
    if (!room) {
      violations.push_back(source.path + ": stands in no room");
      continue;
    }
    for (const Include& include : includes_of(source)) {
      const std::string fault = fault_of(include, source, *room, tree);
      if (fault.empty()) continue;
      violations.push_back(source.path + ":" + std::to_string(include.line) + ": " +
                           include.header + ": " + fault);
    }
  }
  return violations;
}

std::vector<Violation> length_violations(const std::vector<Source>& tree, int limit) {
  std::vector<Violation> violations;
  for (const Source& source : tree) {
    const auto lines = std::count(source.text.begin(), source.text.end(), '\n');
    if (lines > limit) {
      violations.push_back(source.path + ": " + std::to_string(lines) + " lines, more than " +
                           std::to_string(limit));
    }
  }
  return violations;
}

std::vector<Source> read_sources(const std::filesystem::path& root) {
  namespace fs = std::filesystem;
  std::vector<Source> tree;
  for (auto entry = fs::recursive_directory_iterator(root);
       entry != fs::recursive_directory_iterator(); ++entry) {
    const fs::path path = entry->path().lexically_relative(root);
    const std::string name = path.filename().string();
    if (entry->is_directory()) {
      const bool not_ours = name.starts_with(".") || path == "build";
      if (not_ours) entry.disable_recursion_pending();
      continue;
    }
    if (path.extension() != ".cpp" && path.extension() != ".hpp") continue;
    std::ifstream file(entry->path());
    tree.push_back({path.generic_string(), std::string(std::istreambuf_iterator<char>(file), {})});
  }
  return tree;
}

std::vector<Violation> link_violations(const std::vector<Closure>& closures,
                                       const std::vector<Forbidden>& forbidden) {
  std::vector<Violation> violations;
  for (const Forbidden& rule : forbidden) {
    const auto closure =
        std::find_if(closures.begin(), closures.end(),
                     [&](const Closure& candidate) { return candidate.target == rule.target; });
    if (closure == closures.end()) {
      violations.push_back(rule.target + ": no such target, so its links were not checked");
      continue;
    }
    for (const std::string& link : closure->links) {
      if (lower_case(link).find(rule.link) == std::string::npos) continue;
      violations.push_back(rule.target + " links " + link);
    }
  }
  return violations;
}

}  // namespace shakebed::tests
