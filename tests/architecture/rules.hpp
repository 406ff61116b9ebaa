#pragma once

#include <filesystem>
#include <string>
#include <vector>

// Which room may include what, as data, and the check of a source tree against it.
namespace shakebed::tests {

struct Source {
  std::string path;  ///< from the repository's root, "simulator/scene/scene.hpp"
  std::string text;
};

/// One broken rule: "fitting/fit.cpp:12: <tbb/task_group.h>: ..."
using Violation = std::string;

/// A folder and what its sources may include. A source belongs to the longest `folder` that its
/// path starts with.
struct Room {
  std::string folder;
  std::vector<std::string> ours;      ///< prefixes of paths from the root
  std::vector<std::string> packages;  ///< prefixes of other people's headers
  bool posix = false;                 ///< unistd.h, sys/..., and the like
};

/// The rooms, lowest first: no room includes one below it in this list.
const std::vector<Room>& rooms();

/// Headers that one place alone may include, whatever its room allows.
struct Sole {
  std::string header;  ///< prefix
  std::string place;   ///< prefix of the path
};
const std::vector<Sole>& soles();

/// Every #include against the rooms: order, packages, and paths that start at the root and exist.
std::vector<Violation> include_violations(const std::vector<Source>& tree);

/// Sources of more than `limit` lines.
std::vector<Violation> length_violations(const std::vector<Source>& tree, int limit);

/// Every .cpp and .hpp under `root`, builds and hidden folders left out.
std::vector<Source> read_sources(const std::filesystem::path& root);

/// A target and all it links, directly or not, as CMake knows them.
struct Closure {
  std::string target;
  std::vector<std::string> links;
};
/// A target must not link anything with `link` in its name, however CMake writes it: "tbb" is in
/// TBB::tbb and in /usr/lib/libtbb.so. In lower case.
struct Forbidden {
  std::string target;
  std::string link;
};
std::vector<Violation> link_violations(const std::vector<Closure>& closures,
                                       const std::vector<Forbidden>& forbidden);

}  // namespace shakebed::tests
