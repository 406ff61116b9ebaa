#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "simulator/record.hpp"

namespace shakebed::simulator {

/// Averages over one cycle each, for several observables at once. Memory is bounded: when the
/// series is full, neighbouring entries are merged and an entry stands for twice as many cycles.
class CycleSeries {
 public:
  static constexpr std::size_t capacity = 2048;

  explicit CycleSeries(std::vector<Series> observables) : observables_(std::move(observables)) {
    for (auto& observable : observables_) {
      observable.cycles_per_entry = 1;
      observable.values.clear();
    }
    pending_.assign(observables_.size(), 0);
  }

  /// One cycle's averages, in the order of the observables.
  void push(const std::vector<double>& cycle) {
    for (std::size_t k = 0; k < pending_.size(); ++k) pending_[k] += cycle[k];
    ++cycles_;
    if (++pending_cycles_ < cycles_per_entry_) return;
    for (std::size_t k = 0; k < pending_.size(); ++k) {
      observables_[k].values.push_back(pending_[k] / static_cast<double>(pending_cycles_));
      pending_[k] = 0;
    }
    pending_cycles_ = 0;
    if (observables_.front().values.size() == capacity) merge();
  }

  long cycles() const { return cycles_; }
  long cycles_per_entry() const { return cycles_per_entry_; }
  const std::vector<Series>& observables() const { return observables_; }
  const Series& operator[](std::size_t k) const { return observables_[k]; }

 private:
  void merge() {
    for (auto& observable : observables_) {
      auto& v = observable.values;
      for (std::size_t e = 0; e < capacity / 2; ++e) v[e] = 0.5 * (v[2 * e] + v[2 * e + 1]);
      v.resize(capacity / 2);
      observable.cycles_per_entry *= 2;
    }
    cycles_per_entry_ *= 2;
  }

  std::vector<Series> observables_;
  std::vector<double> pending_;
  long pending_cycles_ = 0;
  long cycles_per_entry_ = 1;
  long cycles_ = 0;
};

}  // namespace shakebed::simulator
