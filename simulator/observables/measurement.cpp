#include "simulator/observables/measurement.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace shakebed::simulator {
namespace {

template <int D>
std::vector<std::string> component_names() {
  if constexpr (D == 2) return {"T_x", "T_z"};
  return {"T_x", "T_y", "T_z"};
}

template <int D>
std::vector<Series> observables() {
  std::vector<Series> all;
  for (const auto& name : component_names<D>()) all.push_back({name, "m g d", 1, {}});
  for (const auto& name : component_names<D>()) all.push_back({name + "_lab", "m g d", 1, {}});
  all.push_back({"h_cm", "d", 1, {}});
  all.push_back({"base_power", "m g sqrt(g d)", 1, {}});
  all.push_back({"dissipation_power", "m g sqrt(g d)", 1, {}});
  return all;
}

/// The bottom of the lowest box, which no grain's centre is below.
double lowest_box(const Scene& scene) {
  const bool lab = scene.protocol.profile.frame == Scene::ProfileChoice::Frame::lab;
  const bool sinks = lab && scene.base.direction == DriveDirection::z;
  return sinks ? -std::ceil(scene.base.drive.amplitude) : 0;
}

Estimate scaled(const Estimate& e, double factor) {
  return {e.mean * factor, e.standard_error * factor};
}

std::string formatted(const char* format, double a, double b) {
  char text[200];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

}  // namespace

template <int D>
Measurement<D>::Measurement(const Scene& scene, double rest_height)
    : scene_(scene),
      rest_height_(rest_height),
      profile_(lowest_box(scene), scene.cell_area()),
      series_(observables<D>()) {
  using LocalMean = typename HeightProfile<D>::LocalMean;
  const auto add = [&](const char* suffix, LocalMean mean) {
    other_profiles_.push_back({suffix, {lowest_box(scene), scene.cell_area(), mean}});
  };
  if (scene.protocol.profile.instant) add("_instant", LocalMean::instant);
  if (scene.protocol.profile.phase) add("_phase", LocalMean::phase);
}

template <int D>
void Measurement<D>::end_cycle(const EnergyLedger& ledger) {
  auto cycle = temperature_.take();
  const double period = scene_.base.drive.period();
  cycle.push_back((ledger.base_work - last_.base_work) / period);
  cycle.push_back((ledger.dissipation - last_.dissipation) / period);
  series_.push(cycle);
  profile_.end_cycle();
  for (auto& other : other_profiles_) other.profile.end_cycle();
  sampled_phases_ = 0;
  last_ = ledger;
}

template <int D>
bool Measurement<D>::at_rest() const {
  const bool may_rest = scene_.gravity > 0 && scene_.base.direction == DriveDirection::z;
  if (!may_rest || series_.cycles() == 0) return false;
  const double v = scene_.base.drive.peak_velocity();
  return mean_of_series(series_[D - 1].values).estimate.mean < at_rest_bound * v * v;
}

template <int D>
std::vector<double> Measurement<D>::values_of(const std::string& quantity) const {
  for (const auto& one : series_.observables()) {
    if (one.name == quantity) return one.values;
  }
  const bool total = quantity == "T" || quantity == "T_lab";
  if (total) {
    const std::size_t first = quantity == "T" ? 0 : lab;
    std::vector<double> mean(series_[0].values.size(), 0);
    for (std::size_t c = 0; c < D; ++c) {
      for (std::size_t e = 0; e < mean.size(); ++e) {
        mean[e] += series_[first + c].values[e] / D;
      }
    }
    return mean;
  }
  if (quantity == "delta_h_cm") {
    auto values = series_[height].values;
    for (double& h : values) h -= rest_height_;
    return values;
  }
  return {};
}

template <int D>
MeanOfSeries Measurement<D>::estimator() const {
  return scene_.protocol.cautious_errors ? cautious_mean_of_series : mean_of_series;
}

template <int D>
CorrelatedMean Measurement<D>::mean_of(const std::vector<double>& series) const {
  return estimator()(series);
}

template <int D>
bool Measurement<D>::knows(const std::string& quantity) const {
  if (quantity == "T" || quantity == "T_lab" || quantity == "delta_h_cm") return true;
  for (const auto& one : series_.observables()) {
    if (one.name == quantity) return true;
  }
  return false;
}

template <int D>
bool Measurement<D>::drifts() const {
  return !halves_agree(series_[D - 1].values, estimator()) ||
         !halves_agree(series_[height].values, estimator());
}

template <int D>
bool Measurement<D>::precise_enough(const Scene::Precision& wanted) const {
  const auto mean = mean_of(values_of(wanted.quantity));
  constexpr double least_independent = 30;
  return mean.independent >= least_independent &&
         mean.estimate.standard_error <= wanted.fraction * std::abs(mean.estimate.mean);
}

template <int D>
double Measurement<D>::cycles_needed(const Scene::Precision& wanted) const {
  const auto estimate = mean_of(values_of(wanted.quantity)).estimate;
  const double ratio = estimate.standard_error / (wanted.fraction * std::abs(estimate.mean));
  return static_cast<double>(cycles()) * ratio * ratio;
}

template <int D>
void Measurement<D>::write_temperatures(Record& record) const {
  const double v = scene_.base.drive.peak_velocity();
  auto names = component_names<D>();
  names.push_back("T");
  for (const auto& name : names) {
    for (const std::string suffix : {"", "_lab"}) {
      const auto estimate = mean_of(values_of(name + suffix)).estimate;
      record.quantities.push_back({name + suffix, "m g d", estimate});
      record.quantities.push_back(
          {name + suffix + "_scaled", "m V_p^2", scaled(estimate, 1 / (v * v))});
      if (suffix.empty()) {
        record.quantities.push_back(
            {name + "_twice_scaled", "m V_p^2", scaled(estimate, 2 / (v * v))});
      }
    }
  }
}

template <int D>
void Measurement<D>::write_volume_averages(Record& record) const {
  const double v = scene_.base.drive.peak_velocity();
  auto names = component_names<D>();
  names.push_back("T");
  auto summary = profile_.summarise();
  for (std::size_t c = 0; c < names.size(); ++c) {
    const auto& estimate = summary.volume_temperature[c];
    record.quantities.push_back({names[c] + "_volume", "m g d", estimate});
    record.quantities.push_back(
        {names[c] + "_volume_scaled", "m V_p^2", scaled(estimate, 1 / (v * v))});
  }
  record.quantities.push_back({"packing_fraction", "1", summary.packing_fraction});
  record.scalars.push_back({"averaging_height", "d", summary.averaging_height});
  record.profile = std::move(summary.profile);
}

/// The same boxes as the profile's, in columns of their own.
template <int D>
void Measurement<D>::write_other_profiles(Record& record) const {
  auto names = component_names<D>();
  names.push_back("T");
  const double v = scene_.base.drive.peak_velocity();
  for (const auto& [suffix, profile] : other_profiles_) {
    const auto summary = profile.summarise();
    for (const auto& column : summary.profile.columns) {
      if (!column.name.starts_with("T_")) continue;
      record.profile.columns.push_back(column);
      record.profile.columns.back().name += suffix;
    }
    for (std::size_t c = 0; c < names.size(); ++c) {
      const auto& estimate = summary.volume_temperature[c];
      const auto name = names[c] + "_volume" + suffix;
      record.quantities.push_back({name, "m g d", estimate});
      record.quantities.push_back({name + "_scaled", "m V_p^2", scaled(estimate, 1 / (v * v))});
    }
  }
}

template <int D>
void Measurement<D>::judge_stationarity(Record& record) const {
  record.at_rest = at_rest();
  record.stationary = false;
  const auto& drive = scene_.base.drive;
  const double flights =
      static_cast<double>(series_.cycles()) * drive.period() / scene_.flight_time();
  const auto work = mean_of(series_[base_power].values);
  const auto loss = mean_of(series_[dissipation_power].values);
  const auto& T_z = series_[D - 1].values;
  if (record.at_rest) {
    record.stationary = true;
    record.stationary_reason = formatted(
        "at rest on the base: T_z/(m V_p^2) = %.1e is below %.0e",
        mean_of_series(T_z).estimate.mean / std::pow(drive.peak_velocity(), 2), at_rest_bound);
  } else if (scene_.elastic()) {
    record.stationary_reason = "e = 1 without friction: nothing dissipates, no steady state";
  } else if (T_z.size() < 8) {
    record.stationary_reason = formatted("%.0f cycles are too few to judge; measure at least %.0f",
                                         static_cast<double>(series_.cycles()), 8);
  } else if (flights < 4) {
    record.stationary_reason = formatted(
        "measured for only %.2g flight times (2 V_p/g, or to the lid and back); at least %.0f are "
        "needed to see "
        "more than one throw",
        flights, 4);
  } else if (mean_of(T_z).estimate.standard_error > 0.3 * mean_of(T_z).estimate.mean) {
    record.stationary_reason = "T_z is not known to 30 %: nothing can be said of its drift";
  } else if (work.estimate.mean <= 0) {
    record.stationary_reason = "the base did no net work: the bed is still falling or at rest";
  } else if (std::abs(work.estimate.mean - loss.estimate.mean) >
             4 * std::hypot(work.estimate.standard_error, loss.estimate.standard_error)) {
    record.stationary_reason =
        formatted("base power %.4g and dissipation %.4g differ by more than 4 standard errors",
                  work.estimate.mean, loss.estimate.mean);
  } else if (drifts()) {
    record.stationary_reason =
        "the two halves of the measured cycles differ by more than 3.89 standard errors in T_z or "
        "h_cm";
  } else {
    record.stationary = true;
    record.stationary_reason =
        formatted("halves agree; base power %.4g equals dissipation %.4g within errors",
                  work.estimate.mean, loss.estimate.mean);
  }
}

template <int D>
void Measurement<D>::check_ledger(Record& record, const EnergyLedger& ledger,
                                  double residual) const {
  constexpr double tolerated = 0.02;  // t_c/10 leaves about 1 %
  const double turned_over = std::max({ledger.dissipation, std::abs(ledger.base_work), 1.0});
  if (record.at_rest || std::abs(residual) <= tolerated * turned_over) return;
  record.stationary = false;
  record.stationary_reason = formatted(
      "the energy ledger is open by %.3g m g d of %.3g dissipated: the time step is too "
      "coarse, or contacts were missed",
      residual, ledger.dissipation);
}

template <int D>
void Measurement<D>::write(Record& record, const EnergyLedger& ledger, double energy_change) const {
  const auto& drive = scene_.base.drive;
  write_temperatures(record);
  write_volume_averages(record);
  write_other_profiles(record);
  const auto h_cm = mean_of(values_of("h_cm")).estimate;
  record.quantities.push_back({"h_cm", "d", h_cm});
  if (scene_.gravity > 0) {
    const auto delta = mean_of(values_of("delta_h_cm")).estimate;
    const double v2 = drive.peak_velocity() * drive.peak_velocity();
    record.quantities.push_back({"delta_h_cm", "d", delta});
    record.quantities.push_back(
        {"delta_h_cm_scaled", "V_p^2/g", scaled(delta, scene_.gravity / v2)});
  }
  for (const std::size_t k : {base_power, dissipation_power}) {
    record.quantities.push_back(
        {series_[k].name, series_[k].unit, mean_of(series_[k].values).estimate});
  }
  const auto T_z = mean_of(series_[D - 1].values);
  const double residual = ledger.base_work - ledger.dissipation - energy_change;
  record.scalars.insert(record.scalars.end(),
                        {{"cycles", "1", static_cast<double>(series_.cycles())},
                         {"correlation_time", "cycles",
                          T_z.correlation_time * static_cast<double>(series_.cycles_per_entry())},
                         {"independent_entries", "1", T_z.independent},
                         {"rest_height", "d", rest_height_},
                         {"largest_overlap", "d", ledger.largest_overlap},
                         {"collisions", "1", static_cast<double>(ledger.collisions)},
                         {"contact_steps", "1", static_cast<double>(ledger.contact_steps)},
                         {"base_work", "m g d", ledger.base_work},
                         {"dissipation", "m g d", ledger.dissipation},
                         {"ledger_residual", "m g d", residual}});
  record.series = series_.observables();
  judge_stationarity(record);
  check_ledger(record, ledger, residual);
}

template class Measurement<2>;
template class Measurement<3>;

}  // namespace shakebed::simulator
