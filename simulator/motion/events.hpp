#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "files/error.hpp"
#include "simulator/contact/parameters.hpp"
#include "simulator/motion/calendar.hpp"
#include "simulator/motion/closed_contact.hpp"
#include "simulator/motion/dense.hpp"
#include "simulator/motion/fine_contact.hpp"
#include "simulator/motion/flight.hpp"
#include "simulator/motion/flight_search.hpp"
#include "simulator/motion/isolation.hpp"
#include "simulator/motion/next_touch.hpp"
#include "simulator/motion/ongoing_contact.hpp"

namespace shakebed::simulator {

/// How many contacts went which way, and whether anything slipped through.
struct EventCounters {
  long closed = 0;    ///< contacts taken in closed form
  long fine = 0;      ///< contacts that were stepped because the scene or a neighbour asked for it
  long undone = 0;    ///< contacts in one stride undone because a third grain came near
  long breaches = 0;  ///< grains found overlapping before their touch was seen: must stay 0
  long dense_steps = 0;  ///< steps taken with all grains on the grid
  long dense_stays = 0;  ///< in as many stretches
};

/// When all grains are handed to the dense stepper, and taken back. A hand-over costs as much as
/// some hundred dense steps, so that the two limits lie far apart.
struct HandOver {
  double most_on_grid = 0.3;     ///< share of the grains on the grid above which all join it,
  double root_on_grid = 5;       ///< or that many times the root of their number: rows on the grid
                                 ///< look at each other, which costs as the square of theirs
  double least_touching = 0.02;  ///< contacts per grain down to which they stay there
};

/// Pays for collisions, not for steps: grains fly on parabolas, each with one next event (a touch
/// with a grain or the base, or a second look at periodic images), and only grains in contact are
/// integrated. Contacts that are provably isolated are taken in one stride: `fine` steps them on
/// the global grid and reproduces the uniform engine to rounding, `closed` has their exact
/// solution. All others are stepped on the grid together with whoever is near. When most grains
/// touch, all of them are handed to the dense stepper until they fly again. See docs/engine.md.
template <class Physics>
class EventEngine {
 public:
  static constexpr int D = Physics::dimension;
  static constexpr int S = Physics::GrainState::spin_columns;
  static constexpr int vertical = Dimension<D>::vertical;
  using GrainState = typename Physics::GrainState;
  using SpinRow = Eigen::Matrix<double, S, 1>;

  EventEngine(const Physics& physics, const Parameters& parameters, const GrainState& start,
              ContactOperator contacts, const HandOver& hand_over = {})
      : physics_(physics),
        contacts_(contacts),
        hand_over_(hand_over),
        pair_contact_(parameters.grain_grain, true),
        base_contact_(parameters.grain_base, false),
        count_(start.count()),
        flights_(start.count(), physics.gravity),
        search_(physics.cell, flights_),
        calendar_(start.count()),
        events_(start.count()),
        generation_(start.count(), 0),
        stray_(start.count(), 0),
        state_(start) {
    dense_.emplace(physics_, DenseStepper<Physics>::rows_of(physics_, start), 0,
                   std::vector<PairOfGrains>{}, std::vector<std::uint32_t>{});
    dense_->begin(ledger_);
    ledger_ = {};
  }

  void advance(long steps) {
    const long chunk = std::max(1L, physics_.steps_per_cycle / 64);
    while (steps > 0) {
      advance_to(step_ + std::min(steps, chunk));
      steps -= std::min(steps, chunk);
    }
  }

  const GrainState& synchronised();
  /// Sums over grains as they are now; flights' are carried along, so that asking costs nothing
  /// per grain.
  Moments<D> moments();
  EnergyLedger& ledger() {
    book_ongoing();
    return ledger_;
  }
  const EventCounters& counters() const { return counters_; }
  double energy();
  long step_in_cycle() const { return step_ % physics_.steps_per_cycle; }

 private:
  using PairOfGrains = typename DenseStepper<Physics>::PairOfGrains;
  using Ongoing = OngoingContact<Physics>;
  using Motion = GrainMotion<Physics>;

  enum class EventKind { look_again, pair, base };
  struct Event {
    EventKind kind = EventKind::look_again;
    std::uint32_t partner = 0;
    std::uint32_t partner_generation = 0;
  };

  // Time is counted from the epoch, which moves along: a step of the run and a short double.
  double time_of(long step) const {
    return static_cast<double>(step - epoch_step_) * physics_.time_step;
  }
  double epoch_phase() const {
    return static_cast<double>(epoch_step_ % physics_.steps_per_cycle) /
           static_cast<double>(physics_.steps_per_cycle);
  }
  double period() const {
    return physics_.time_step * static_cast<double>(physics_.steps_per_cycle);
  }
  /// The last step of the grid before time t, not before the epoch.
  long last_step_before(double t) const {
    return epoch_step_ + std::max(0L, static_cast<long>(std::ceil(t / physics_.time_step)) - 1);
  }
  BaseState base_at(double t) const { return physics_.base.at(epoch_phase() + t / period()); }
  BaseState base_at_step(long step) const {
    return physics_.base_at_step(step % physics_.steps_per_cycle);
  }

  /// The most a flight's speed grows until the next rebase, and then some.
  double gained_in_epoch() const {
    return physics_.gravity * period() * 2 / static_cast<double>(epochs_per_cycle);
  }
  bool is_open(const Ongoing& contact) const {
    return contact.end() > std::max(time_of(step_), over_until_);
  }

  void advance_to(long target);
  void rebase();
  void guard_progress(double t);

  // Events.
  void predict(std::uint32_t i, double from);
  void handle(std::uint32_t i, double t);
  void touch_pair(std::uint32_t i, std::uint32_t j, double t);
  void touch_base(std::uint32_t i, double t);
  Motion motion_of(std::uint32_t i, double t) const;
  void launch(std::uint32_t i, const Motion& motion, double t);

  // Contacts taken in one stride.
  bool steps_contacts() const { return contacts_ == ContactOperator::fine; }
  bool take_pair_in_one_stride(std::uint32_t i, std::uint32_t j, double t);
  bool take_base_in_one_stride(std::uint32_t i, double t);
  bool find_end(Ongoing& contact, const RelativeMotion<D>& touch);
  void close(Ongoing& contact, const RelativeMotion<D>& touch);
  bool step_through(Ongoing& contact, const RelativeMotion<D>& touch);
  bool isolated(const IsolatedGrain<D>* members, std::size_t count, double t, double duration);
  void begin_stride(const Ongoing& contact, double stray);
  SteppedContact<Physics> step_again(const Ongoing& contact) const;
  SteppedContact<Physics> as_it_is_now(const Ongoing& contact) const;
  typename Ongoing::Both motions_now(const Ongoing& contact) const;
  void book_ongoing();
  void book(Ongoing& contact, const EnergyLedger& so_far);
  void drop_ended();

  // Grains on the grid.
  void step_fine();
  void activate(std::uint32_t i, double t);
  void take_out_of_flight(std::uint32_t i);
  void release_idle();
  void look_around();
  void look_around(std::uint32_t k);
  void take_in_flights(const Vector<D>& x, double cap);
  bool is_ongoing(std::uint32_t grain) const;
  bool near_ongoing(std::size_t k);
  void undo(std::uint32_t grain);
  void take_up_stepped(const Ongoing& contact);
  void take_up_closed(const Ongoing& contact);
  static void set_predicted(GridRow<Physics>& row, const Motion& now);
  void set_half(GridRow<Physics>& row, const Motion& now) const;

  // Hand-over between events and the dense stepper.
  bool too_dense() const {
    constexpr double few = 8;
    const auto grains = static_cast<double>(count_);
    return static_cast<double>(fine_.count()) >
           std::max(few, std::min(std::floor(hand_over_.most_on_grid * grains),
                                  hand_over_.root_on_grid * std::sqrt(grains)));
  }
  bool dilute(long touching) const {
    return static_cast<double>(touching) <=
           std::floor(hand_over_.least_touching * static_cast<double>(count_));
  }
  void enter_dense();
  void run_dense(long target);
  void leave_dense();
  void be_patient();

  static constexpr long epochs_per_cycle = 16;
  static constexpr long look_window = 24;  ///< steps between a row's looks around
  static constexpr long dense_look = 32;   ///< steps between looks whether a dense bed flies again

  Physics physics_;
  ContactOperator contacts_;
  HandOver hand_over_;
  ClosedContact<D, Physics::turns_grains> pair_contact_;
  ClosedContact<D, Physics::turns_grains> base_contact_;
  std::size_t count_;

  long step_ = 0;        ///< grid step the run (or the grains on the grid) has reached
  long epoch_step_ = 0;  ///< grid step at which the flights' time is zero
  Flights<D, static_cast<std::size_t>(S)> flights_;
  FlightSearch<D, static_cast<std::size_t>(S)> search_;
  Calendar calendar_;
  std::vector<Event> events_;
  std::vector<std::uint32_t> generation_;  ///< raised whenever a grain's flight ends
  double fastest_flight_ = 0;
  std::vector<Ongoing> ongoing_;
  double over_until_ = -never;  ///< closed contacts that end before are over
  double largest_stray_ = 0;    ///< of the contacts in ongoing_
  std::vector<double> stray_;   ///< of grains in an ongoing contact: how far from their next flight
  FineContacts<Physics> fine_;
  std::vector<char> stays_;  ///< rows of fine_
  std::optional<DenseStepper<Physics>> dense_;
  long entered_dense_at_ = 0;
  long left_dense_at_ = 0;
  long least_stay_ = dense_look;  ///< of the present stay in the dense stepper

  EnergyLedger ledger_;
  EventCounters counters_;
  GrainState state_;
  std::vector<std::uint32_t> near_;
  std::vector<std::uint32_t> released_;
  double last_event_time_ = 0;
  long events_without_progress_ = 0;
};

}  // namespace shakebed::simulator

#include "simulator/motion/events_dense.hpp"
#include "simulator/motion/events_flying.hpp"
#include "simulator/motion/events_on_grid.hpp"
#include "simulator/motion/events_stride.hpp"
#include "simulator/motion/events_undo.hpp"
