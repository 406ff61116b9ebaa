#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include "simulator/motion/column/rows.hpp"

namespace shakebed::simulator {

/// Pairs of rows in arrays that SIMD loads can read: what a contact needs beside the rows, and its
/// memory when it has one. Kept longer than its size by a vector of harmless pairs.
template <bool HasMemory>
class PairList {
 public:
  static constexpr std::size_t memory_columns = HasMemory ? 3 : 0;

  std::size_t size() const { return size_; }
  const std::uint32_t* i() const { return i_.data(); }
  const std::uint32_t* j() const { return j_.data(); }
  const double* contact_size() const { return contact_size_.data(); }
  const double* effective_mass() const { return effective_mass_.data(); }
  auto& memory_columns_of() { return memory_; }

  Triple<double> memory_at(std::size_t k) const {
    if constexpr (!HasMemory) {
      return {0, 0, 0};
    } else {
      return {memory_[0][k], memory_[1][k], memory_[2][k]};
    }
  }

  void clear() { resize(0); }

  void push(std::uint32_t a, std::uint32_t b, double contact_size, double effective_mass,
            const Triple<double>& u = {0, 0, 0}) {
    resize(size_ + 1);
    set(size_ - 1, a, b, contact_size, effective_mass, u);
  }

  /// The last pair takes the place of pair k.
  void remove(std::size_t k) {
    const std::size_t last = size_ - 1;
    set(k, i_[last], j_[last], contact_size_[last], effective_mass_[last], memory_at(last));
    resize(last);
  }

  /// Fills the vector that begins before the end and goes past it with the pair (a, b).
  void pad(std::uint32_t a, std::uint32_t b) {
    resize(size_);
    for (std::size_t k = size_; k < size_ + lane_count; ++k) set(k, a, b, 1, 0.5, {0, 0, 0});
  }

  /// Rows were put in another order: row r is now called new_row[r].
  void rename(const std::vector<std::uint32_t>& new_row) {
    for (std::size_t k = 0; k < size_; ++k) {
      i_[k] = new_row[i_[k]];
      j_[k] = new_row[j_[k]];
    }
  }

  /// In rising order of i, then j: neighbours in memory one after the other.
  void sort() {
    std::vector<std::uint32_t> order(size_);
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return i_[a] != i_[b] ? i_[a] < i_[b] : j_[a] < j_[b];
    });
    take(i_, order);
    take(j_, order);
    take(contact_size_, order);
    take(effective_mass_, order);
    for (auto& column : memory_) take(column, order);
  }

  template <class Archive>
  void archive(Archive& a) {
    a(size_);
    a(i_);
    a(j_);
    a(contact_size_);
    a(effective_mass_);
    for (auto& column : memory_) a(column);
  }

 private:
  void resize(std::size_t n) {
    size_ = n;
    const std::size_t needed = n + lane_count;
    if (i_.size() >= needed) return;
    const std::size_t room = needed + needed / 2;
    i_.resize(room);
    j_.resize(room);
    contact_size_.resize(room);
    effective_mass_.resize(room);
    for (auto& column : memory_) column.resize(room);
  }

  template <class Value>
  static void take(std::vector<Value>& values, const std::vector<std::uint32_t>& order) {
    const std::vector<Value> before = values;
    for (std::size_t k = 0; k < order.size(); ++k) values[k] = before[order[k]];
  }

  void set(std::size_t k, std::uint32_t a, std::uint32_t b, double contact_size,
           double effective_mass, const Triple<double>& u) {
    i_[k] = a;
    j_[k] = b;
    contact_size_[k] = contact_size;
    effective_mass_[k] = effective_mass;
    if constexpr (HasMemory) {
      memory_[0][k] = u.x;
      memory_[1][k] = u.y;
      memory_[2][k] = u.z;
    }
  }

  std::size_t size_ = 0;
  std::vector<std::uint32_t> i_;
  std::vector<std::uint32_t> j_;
  std::vector<double> contact_size_;
  std::vector<double> effective_mass_;
  std::array<std::vector<double>, memory_columns> memory_;
};

}  // namespace shakebed::simulator
