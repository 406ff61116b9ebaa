#include "simulator/observables/snapshot.hpp"

#include <cstdio>

namespace shakebed::simulator {

std::string snapshot_name(double cycles) {
  char text[64];
  std::snprintf(text, sizeof text, "T%.6f", cycles);
  std::string name(text);
  name.erase(name.find_last_not_of('0') + 1);
  if (name.ends_with('.')) name.pop_back();
  return name;
}

}  // namespace shakebed::simulator
