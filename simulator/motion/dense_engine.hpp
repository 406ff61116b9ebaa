#pragma once

#include "simulator/motion/dense.hpp"
#include "simulator/motion/walled_physics.hpp"

namespace shakebed::simulator {

/// A whole run on the dense stepper: for beds between walls, where flights have no calendar but
/// most grains fly all the same. Windows are longer than in beds that are dense, since there are
/// more grains to carry over them than pairs to watch.
template <class Physics>
class DenseEngine {
 public:
  static constexpr int D = Physics::dimension;
  using GrainState = typename Physics::GrainState;

  /// Starts at step 0 of a cycle (the base at its mean height, moving up).
  DenseEngine(const Physics& physics, const GrainState& start)
      : physics_(physics),
        stepper_(physics, DenseStepper<Physics>::rows_of(physics, start), 0, {}, {}, window_steps),
        state_(start) {
    stepper_.begin(ledger_);
    ledger_ = {};
  }

  void advance(long steps) {
    for (long s = 0; s < steps; ++s) stepper_.step(ledger_);
  }

  const GrainState& synchronised() {
    const auto& rows = stepper_.rows();
    const double dt = physics_.time_step;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      set_row(state_.position, i, rows[i].position());
      set_row(state_.velocity, i, rows[i].velocity_now(dt));
      set_row(state_.spin, i, rows[i].spin_now(dt));
    }
    return state_;
  }

  EnergyLedger& ledger() { return ledger_; }
  double energy() {
    return mechanical_energy(synchronised(), physics_.gravity) + stepper_.elastic_energy();
  }

 private:
  static constexpr long window_steps = 96;

  Physics physics_;
  DenseStepper<Physics> stepper_;
  GrainState state_;
  EnergyLedger ledger_;
};

}  // namespace shakebed::simulator
