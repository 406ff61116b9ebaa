#pragma once

#include <filesystem>
#include <vector>

#include "figures/assemble.hpp"
#include "figures/specification.hpp"

namespace shakebed::figures {

/// Writes a figure into `folder`: <id>.csv (the first part), <id>-<part>.csv (the others), <id>.svg
/// and <id>.png; a table as <id>.csv, <id>.txt and <id>.md. Each file appears under its name only
/// when complete. Returns what was written.
std::vector<std::filesystem::path> make_figure(const Specification& specification,
                                               const Tables& tables,
                                               const std::filesystem::path& folder);

}  // namespace shakebed::figures
