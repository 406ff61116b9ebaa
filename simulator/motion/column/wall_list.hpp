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

  /// Row `i` fills up vectors: it lies far from every wall.
  void fill_up_with(std::uint32_t i) {
    padding_ = i;
    clear();
  }

  void clear() {
    size = 0;
    make_room();
    for (std::size_t k = 0; k < lane_count; ++k) set_padding(k);
  }

  void push(std::uint32_t i, double a, double m, const Triple<double>& u) {
    ++size;
    make_room();
    set(size - 1, i, a, m, u);
    set_padding(size + lane_count - 1);
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
  void set_padding(std::size_t k) { set(k, padding_, 0, 1, {0, 0, 0}); }

  void make_room() {
    const std::size_t needed = size + lane_count;
    if (row.size() >= needed) return;
    row.resize(2 * needed);
    radius.resize(2 * needed);
    mass.resize(2 * needed);
    for (auto& column : memory) column.resize(2 * needed);
  }

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

  std::uint32_t padding_ = 0;
};

}  // namespace shakebed::simulator
