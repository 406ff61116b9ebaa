#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "simulator/motion/contact_vector.hpp"

namespace shakebed::simulator {

/// What contacts add to the ledger. Their dissipation is summed by every eighth contact, so that
/// one sum need not wait for another, and that in the same order however wide the vectors are.
class TouchCount {
 public:
  [[gnu::always_inline]] void count(const LaneMask& touching, const Lanes& overlap,
                                    const Lanes& dissipated_power) {
    steps_ += std::experimental::popcount(touching);
    std::experimental::where(overlap > largest_overlap_, largest_overlap_) = overlap;
    power_[vector_++ % sums] += dissipated_power;
  }
  void book(EnergyLedger& ledger, double time_step) const {
    ledger.contact_steps += steps_;
    ledger.largest_overlap =
        std::max(ledger.largest_overlap, std::experimental::hmax(largest_overlap_));
    double power = 0;
    for (const Lanes& lanes : power_) {
      for (std::size_t q = 0; q < lane_count; ++q) power += lanes[q];
    }
    ledger.dissipation += power * time_step;
  }

 private:
  long steps_ = 0;
  static constexpr std::size_t sums = std::max<std::size_t>(1, 8 / lane_count);
  std::size_t vector_ = 0;
  std::array<Lanes, sums> power_{};
  Lanes largest_overlap_{0.0};
};

/// Adds the forces of the pairs in touch to their rows; the numbers of those that have come apart
/// go to `ended`, in rising order. Some vectors are gathered, then evaluated, then added: the
/// processor looks ahead about one vector only.
template <class Physics>
void touch_pairs(const Physics& physics, const ListedPairs<Physics::dimension>& list,
                 GridRow<Physics>* rows, EnergyLedger& ledger, std::vector<std::uint32_t>& ended) {
  constexpr std::size_t together = 4;
  ended.clear();
  const auto* pairs = list.begin();
  const std::size_t n = list.size();
  TouchCount sums;
  ContactVector<Physics> contacts[together];
  for (std::size_t first = 0; first < n; first += together * lane_count) {
    const std::size_t vectors = std::min(together, (n - first + lane_count - 1) / lane_count);
    for (std::size_t b = 0; b < vectors; ++b) {
      contacts[b].gather_pairs(rows, pairs + first + b * lane_count);
    }
    for (std::size_t b = 0; b < vectors; ++b) {
      auto& contact = contacts[b];
      const std::size_t k = first + b * lane_count;
      const LaneMask touching = contact.overlap > Lanes(0.0);
      contact.evaluate(physics.grain_grain);
      if (!std::experimental::all_of(touching)) [[unlikely]] {
        contact.mask(touching);
        list_set_lanes(!touching, k, n - k, ended);
      }
      sums.count(touching, contact.overlap, contact.dissipated_power);
    }
    for (std::size_t b = 0; b < vectors; ++b) {
      contacts[b].scatter_pairs(rows, pairs + first + b * lane_count);
    }
  }
  sums.book(ledger, physics.time_step);
}

/// A row that touches the base.
struct BaseHit {
  std::uint32_t row;
  double overlap;
};

/// Adds the forces of contacts with the base.
template <class Physics>
void touch_base(const Physics& physics, const BaseState& base, const std::vector<BaseHit>& hits,
                GridRow<Physics>* rows, EnergyLedger& ledger) {
  using Contact = ContactVector<Physics>;
  constexpr int vertical = Dimension<Physics::dimension>::vertical;
  Contact contact;
  contact.normal.setConstant(Lanes(0.0));
  contact.normal[vertical] = -1;
  TouchCount sums;
  for (std::size_t k = 0; k < hits.size(); k += lane_count) {
    const std::size_t count = std::min(lane_count, hits.size() - k);
    const auto hit = [&](std::size_t q) -> const BaseHit& { return hits[k + (q < count ? q : 0)]; };
    typename Contact::Rates rates;
    for (std::size_t q = 0; q < lane_count; ++q) {
      for (std::size_t p = 0; p < Contact::parts; ++p) {
        rates[p][q] = load_part<typename Contact::Part>(rows[hit(q).row].predicted.data() +
                                                        p * Contact::part_size);
      }
    }
    contact.set_motion(rates);
    contact.motion[vertical] -= base.velocity;
    contact.overlap = Lanes([&](std::size_t q) { return q < count ? hit(q).overlap : 0.0; });
    contact.evaluate(physics.grain_base);
    const LaneMask touching = contact.overlap > Lanes(0.0);
    contact.mask(touching);
    sums.count(touching, contact.overlap, contact.dissipated_power);
    contact.get_changes(rates);
    for (std::size_t q = 0; q < count; ++q) {
      for (std::size_t p = 0; p < Contact::parts; ++p) {
        Contact::add(rows[hit(q).row], p, rates[p][q]);
      }
      ledger.base_work += contact.change[vertical][q] * base.velocity * physics.time_step;
    }
  }
  sums.book(ledger, physics.time_step);
}

/// Numbers of the pairs that have come to touch, in rising order.
template <class Physics>
void find_begun(const ListedPairs<Physics::dimension>& list, const GridRow<Physics>* rows,
                std::vector<std::uint32_t>& begun) {
  begun.clear();
  const Lanes touching(4 * grain_radius * grain_radius);
  for (std::size_t k = 0; k < list.size(); k += lane_count) {
    const LaneMask near =
        ContactVector<Physics>::squared_distances(rows, list.begin() + k) < touching;
    if (std::experimental::any_of(near)) [[unlikely]]
      list_set_lanes(near, k, list.size() - k, begun);
  }
}

}  // namespace shakebed::simulator
