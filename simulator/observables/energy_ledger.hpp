#pragma once

#include <algorithm>

namespace shakebed::simulator {

/// What went in and out since the ledger was opened: change of mechanical and stored elastic
/// energy = base work - dissipation, closing to O(dt^2). The base's work is -F . v_b dt with F the
/// force it puts on a grain's partner, taken at the same instant as the force.
struct EnergyLedger {
  double base_work = 0;        ///< done by the base on the bed [m g d]
  double dissipation = 0;      ///< in dashpots and by friction [m g d]
  double largest_overlap = 0;  ///< [d]
  long collisions = 0;         ///< contacts begun, grain-grain and grain-base
  long contact_steps = 0;      ///< steps spent in contact, summed over contacts

  void count_step(double overlap, bool begins) {
    largest_overlap = std::max(largest_overlap, overlap);
    ++contact_steps;
    collisions += begins;
  }

  void add(const EnergyLedger& part) {
    base_work += part.base_work;
    dissipation += part.dissipation;
    largest_overlap = std::max(largest_overlap, part.largest_overlap);
    collisions += part.collisions;
    contact_steps += part.contact_steps;
  }

  /// Takes back what was added; the largest overlap stays.
  void take_back(const EnergyLedger& part) {
    base_work -= part.base_work;
    dissipation -= part.dissipation;
    collisions -= part.collisions;
    contact_steps -= part.contact_steps;
  }
};

}  // namespace shakebed::simulator
