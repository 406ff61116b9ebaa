#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "simulator/motion/column/rows.hpp"

namespace shakebed::simulator {

/// Rows that may meet one wall within the present window, in arrays for SIMD loads, with the
/// memory of their contact when the law has one.
template <bool HasMemory>
struct WallList {
  static constexpr std::size_t memory_columns = HasMemory ? 3 : 0;

  std::size_t size = 0;
  std::vector<std::uint32_t> row;
  std::vector<double> radius;
  std::vector<double> mass;
  std::array<std::vector<double>, memory_columns> memory;

  void clear() { size = 0; }

  void push(std::uint32_t i, double a, double m, const Triple<double>& u) {
    ++size;
    const std::size_t needed = size + lane_count;
    if (row.size() < needed) {
      row.resize(2 * needed);
      radius.resize(2 * needed);
      mass.resize(2 * needed);
      for (auto& column : memory) column.resize(2 * needed);
    }
    set(size - 1, i, a, m, u);
  }

  /// Fills the last vector with a row that lies far from every wall.
  void pad(std::uint32_t nowhere) {
    for (std::size_t k = size; k < size + lane_count && k < row.size(); ++k) {
      set(k, nowhere, 0, 1, {0, 0, 0});
    }
  }

  Triple<double> memory_at(std::size_t k) const {
    if constexpr (!HasMemory) {
      return {0, 0, 0};
    } else {
      return {memory[0][k], memory[1][k], memory[2][k]};
    }
  }

  template <class Archive>
  void archive(Archive& a) {
    a(size);
    a(row);
    a(radius);
    a(mass);
    for (auto& column : memory) a(column);
  }

 private:
  void set(std::size_t k, std::uint32_t i, double a, double m, const Triple<double>& u) {
    row[k] = i;
    radius[k] = a;
    mass[k] = m;
    if constexpr (HasMemory) {
      memory[0][k] = u.x;
      memory[1][k] = u.y;
      memory[2][k] = u.z;
    }
  }
};

}  // namespace shakebed::simulator
