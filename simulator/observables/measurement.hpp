#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulator/contact/parameters.hpp"
#include "simulator/observables/correlation.hpp"
#include "simulator/observables/cycle_series.hpp"
#include "simulator/observables/energy_ledger.hpp"
#include "simulator/observables/height_profile.hpp"
#include "simulator/observables/temperature.hpp"
#include "simulator/record.hpp"
#include "simulator/scene/scene.hpp"

namespace shakebed::simulator {

/// Below this T_z/(m V_p^2) a vertically driven bed with g > 0 counts as at rest on its base.
inline constexpr double at_rest_bound = 1e-6;

/// Collects what is sampled at equal phases and turns it into a Record's means and errors.
template <int D>
class Measurement {
 public:
  Measurement(const Scene& scene, double rest_height);

  /// One of the cycle's equal phases.
  void sample(const Moments<D>& moments) {
    temperature_.sample(moments);
    ++sampled_phases_;
  }

  /// A grain moves 0.4 A from one sixteenth of a cycle to the next: in boxes of depth d there is
  /// nothing to learn between them, and profiles are the dear part of a sample.
  bool profile_is_due() const { return sampled_phases_ % (phases_per_cycle / profile_phases) == 0; }

  template <class GrainState>
  void sample_profile(const GrainState& grains) {
    const BaseState origin = origin_now();
    profile_.sample(grains, origin);
    const auto phase = static_cast<std::size_t>(
        sampled_phases_ * static_cast<long>(HeightProfile<D>::phases) / phases_per_cycle - 1);
    for (auto& other : other_profiles_) other.profile.sample(grains, origin, phase);
  }

  /// Closes a cycle; the ledger's totals are those since measuring began.
  void end_cycle(const EnergyLedger& ledger);

  long cycles() const { return series_.cycles(); }
  bool at_rest() const;
  /// True when `quantity` is known to the fraction asked for: standard error / mean, with at least
  /// 30 independent entries (fewer make the error itself too uncertain to stop on).
  bool precise_enough(const Scene::Precision& wanted) const;
  /// How many cycles that will have taken, as far as the present error tells: it falls with the
  /// root of the cycles.
  double cycles_needed(const Scene::Precision& wanted) const;
  bool knows(const std::string& quantity) const;
  bool drifts() const;  ///< the halves of what was measured differ, in T_z or h_cm
  void restart() { *this = Measurement(scene_, rest_height_); }

  /// Quantities, profile, series, stationarity. `energy_change` is the ledger's other side.
  void write(Record& record, const EnergyLedger& ledger, double energy_change) const;

 private:
  /// Indices into the series.
  static constexpr std::size_t lab = D, height = 2 * D, base_power = 2 * D + 1,
                               dissipation_power = 2 * D + 2;

  static constexpr long profile_phases = HeightProfile<D>::phases;

  /// Where profiles are taken from at the present one of the cycle's equal phases, 1/n, 2/n, ... 1.
  BaseState origin_now() const {
    const bool rises = scene_.base.direction == DriveDirection::z;
    if (!rises || scene_.protocol.profile.frame == Scene::ProfileChoice::Frame::lab) return {0, 0};
    const auto& drive = scene_.base.drive;
    const double phase = static_cast<double>(sampled_phases_) / phases_per_cycle;
    return BaseMotion{drive.amplitude, drive.peak_velocity()}.at(phase);
  }

  std::vector<double> values_of(const std::string& quantity) const;
  MeanOfSeries estimator() const;
  CorrelatedMean mean_of(const std::vector<double>& series) const;
  void write_temperatures(Record& record) const;
  void write_volume_averages(Record& record) const;
  void write_other_profiles(Record& record) const;
  void judge_stationarity(Record& record) const;
  /// A ledger that does not close makes every other number doubtful.
  void check_ledger(Record& record, const EnergyLedger& ledger, double residual) const;

  Scene scene_;
  double rest_height_;
  int sampled_phases_ = 0;  ///< of this cycle
  TemperatureSums<D> temperature_;
  HeightProfile<D> profile_;
  struct OtherProfile {
    const char* suffix;
    HeightProfile<D> profile;
  };
  std::vector<OtherProfile>
      other_profiles_;  ///< with other local means, if the scene asks for them
  CycleSeries series_;
  EnergyLedger last_;
};

}  // namespace shakebed::simulator
