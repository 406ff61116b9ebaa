#pragma once

#include <cstdio>
#include <string>

#include "files/csv.hpp"

namespace shakebed::cli {

/// How `shakebed check` writes: a title and what there is to say, numbers to four digits.
inline std::string rounded(double value) { return files::rounded_text(value, 4); }

inline void line(const char* title, const std::string& text) {
  std::printf("%-13s %s\n", title, text.c_str());
}

}  // namespace shakebed::cli
