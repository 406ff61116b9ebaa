#pragma once

#include <limits>
#include <string_view>

#include "simulator/record.hpp"

namespace shakebed::simulator {

/// The record's scalar of that name; NaN if it has none.
inline double scalar_of(const Record& record, std::string_view name) {
  for (const auto& scalar : record.scalars) {
    if (scalar.name == name) return scalar.value;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace shakebed::simulator
