#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include "simulator/motion/column/rows.hpp"

namespace shakebed::simulator {

/// Pairs of rows in arrays that SIMD loads can read: what a contact needs beside the rows, and its
/// memory when it has one. A vector of harmless pairs stands behind the last.
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

  /// Row `a` and the next one fill up vectors: they touch nothing.
  void fill_up_with(std::uint32_t a) {
    padding_ = a;
    clear();
  }

  void clear() {
    size_ = 0;
    make_room();
    for (std::size_t k = 0; k < lane_count; ++k) set_padding(k);
  }

  void push(std::uint32_t a, std::uint32_t b, double contact_size, double effective_mass,
            const Triple<double>& u = {0, 0, 0}) {
    ++size_;
    make_room();
    set(size_ - 1, a, b, contact_size, effective_mass, u);
    set_padding(size_ + lane_count - 1);
  }

  /// The last pair takes the place of pair k.
  void remove(std::size_t k) {
    const std::size_t last = --size_;
    set(k, i_[last], j_[last], contact_size_[last], effective_mass_[last], memory_at(last));
    set_padding(last);
  }

  /// Numbers of the pairs in rising order of i, then j, for rows below `rows`.
  std::vector<std::uint32_t> sorted(std::size_t rows) const {
    return stably_by(i_, stably_by(j_, {}, rows), rows);
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
  void set_padding(std::size_t k) { set(k, padding_, padding_ + 1, 1, 0.5, {0, 0, 0}); }

  void make_room() {
    const std::size_t needed = size_ + lane_count;
    if (i_.size() >= needed) return;
    const std::size_t room = needed + needed / 2;
    i_.resize(room);
    j_.resize(room);
    contact_size_.resize(room);
    effective_mass_.resize(room);
    for (auto& column : memory_) column.resize(room);
  }

  /// `order` (all pairs as they stand, if empty) by counting sort.
  std::vector<std::uint32_t> stably_by(const std::vector<std::uint32_t>& row,
                                       const std::vector<std::uint32_t>& order,
                                       std::size_t rows) const {
    std::vector<std::uint32_t> next(rows + 1, 0);
    for (std::size_t k = 0; k < size_; ++k) ++next[row[k] + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::vector<std::uint32_t> by(size_);
    for (std::uint32_t n = 0; n < size_; ++n) {
      const std::uint32_t k = order.empty() ? n : order[n];
      by[next[row[k]]++] = k;
    }
    return by;
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

  std::uint32_t padding_ = 0;
  std::size_t size_ = 0;
  std::vector<std::uint32_t> i_;
  std::vector<std::uint32_t> j_;
  std::vector<double> contact_size_;
  std::vector<double> effective_mass_;
  std::array<std::vector<double>, memory_columns> memory_;
};

}  // namespace shakebed::simulator
