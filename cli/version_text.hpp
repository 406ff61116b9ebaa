#pragma once

#include <string>

#include "files/build_info.hpp"

namespace shakebed::cli {

inline std::string version_text() {
  using namespace files;
  std::string text = "shakebed " + std::string(version());
  text += "\nrevision " + std::string(git_revision());
  text += "\ncompiled by " + std::string(compiler()) + " with " + std::string(compiler_flags());
  return text + "\nfor " + std::string(machine()) + ", preset " + std::string(preset());
}

}  // namespace shakebed::cli
