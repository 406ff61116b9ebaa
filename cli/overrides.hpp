#pragma once

#include <string>
#include <vector>

#include "simulator/scene/read_scene.hpp"

namespace shakebed::cli {

/// "--set base.drive.W=30" words into overrides; refuses what has no '=' or no key before it.
std::vector<simulator::Override> parse_overrides(const std::vector<std::string>& words);

}  // namespace shakebed::cli
