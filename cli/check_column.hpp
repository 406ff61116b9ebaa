#pragma once

#include <string>

#include "simulator/scene/scene.hpp"

namespace shakebed::cli {

/// What the program makes of a bed in a container, on standard output.
void print_column_scene(const std::string& name, const simulator::Scene& scene);

}  // namespace shakebed::cli
