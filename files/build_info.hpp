#pragma once

#include <string_view>

namespace shakebed::files {

// What made this binary, for the provenance of results. The same scene, seed and physics version
// give the same bytes on one binary, and the same statistics on any.

/// "0.1.0": the version in CMakeLists.txt.
std::string_view version();
/// The commit, 12 hexadecimal digits, with "-modified" when tracked files differ from it;
/// "unknown" outside a git clone. Taken at build time.
std::string_view git_revision();
/// "GNU 12.2.0".
std::string_view compiler();
/// The flags that can change numbers: "-O3 -DNDEBUG -march=native -ffp-contract=off".
std::string_view compiler_flags();
/// What -march came to: "x86-64-v3", or "native (sapphirerapids)".
std::string_view machine();
/// The CMake preset ("release", "portable", ...); "none" without one.
std::string_view preset();

}  // namespace shakebed::files
