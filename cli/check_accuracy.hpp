#pragma once

#include <string>

namespace shakebed::cli {

/// What `accuracy` promises and what it chooses, as a Markdown table (docs/accuracy.md).
std::string accuracy_markdown();

}  // namespace shakebed::cli
