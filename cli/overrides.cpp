#include "cli/overrides.hpp"

#include "files/error.hpp"

namespace shakebed::cli {

std::vector<simulator::Override> parse_overrides(const std::vector<std::string>& words) {
  std::vector<simulator::Override> overrides;
  for (const auto& word : words) {
    const auto equals = word.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw files::bad_input("--set " + word,
                             "expected key=value with the key's dotted path, for instance "
                             "--set base.drive.W=30");
    }
    overrides.push_back({word.substr(0, equals), word.substr(equals + 1)});
  }
  return overrides;
}

}  // namespace shakebed::cli
