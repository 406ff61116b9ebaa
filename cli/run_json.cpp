#include "cli/run_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "simulator/record_lookup.hpp"

namespace shakebed::cli {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json whole(double value) {
  return std::isfinite(value) ? Json(std::llround(value)) : Json(nullptr);
}

Json estimate(const simulator::Record& record, const std::string& name) {
  for (const auto& one : record.quantities) {
    if (one.name != name) continue;
    return {{"mean", number(one.estimate.mean)},
            {"standard_error", number(one.estimate.standard_error)}};
  }
  return nullptr;
}

Json temperature(const simulator::Record& record, const std::string& name) {
  Json value = estimate(record, name);
  if (value.is_null()) return nullptr;
  return {{"scaled", estimate(record, name + "_scaled")}, {"value", value}};
}

}  // namespace

Json run_json(const simulator::Record& record, double process_cpu_seconds) {
  Json json;
  json["physics_version"] = record.physics_version;
  json["seed"] = record.seed;
  json["dimension"] = record.dimension;
  json["grains"] = whole(scalar_of(record, "grains"));
  json["layers"] = number(scalar_of(record, "layers"));
  for (const auto* name : {"W", "Gamma", "V_p", "amplitude", "angular_frequency"}) {
    json[name] = number(scalar_of(record, name));
  }
  json["cycles"] = whole(scalar_of(record, "cycles"));
  json["transient_cycles"] = whole(scalar_of(record, "transient"));
  for (const auto* name : {"k_n", "time_step", "contact_duration"}) {
    json[name] = number(scalar_of(record, name));
  }
  json["steps_per_cycle"] = whole(scalar_of(record, "steps_per_cycle"));
  for (const std::string suffix : {"", "_lab", "_volume"}) {
    for (const std::string name : {"T_z", "T_x", "T_y", "T"}) {
      json[name + suffix] = temperature(record, name + suffix);
    }
  }
  json["volume_height"] = number(scalar_of(record, "averaging_height"));
  json["packing_fraction"] = estimate(record, "packing_fraction");
  json["h_cm"] = estimate(record, "h_cm");
  json["rest_height"] = number(scalar_of(record, "rest_height"));
  json["delta_h_cm"] = estimate(record, "delta_h_cm");
  for (const auto* name : {"base_power", "dissipation_power"}) json[name] = estimate(record, name);
  for (const auto* name :
       {"correlation_time", "independent_entries", "ledger_residual", "largest_overlap"}) {
    json[name] = number(scalar_of(record, name));
  }
  for (const auto* name : {"collisions", "contact_steps", "contacts_closed", "contacts_fine",
                           "contacts_undone", "breaches", "dense_steps"}) {
    json[name] = whole(scalar_of(record, name));
  }
  json["cpu_seconds"] = process_cpu_seconds;
  json["cpu_seconds_measuring"] = record.timing.cpu_seconds_measuring;
  json["stationary"] = record.stationary;
  json["stationary_reason"] = record.stationary_reason;
  json["at_rest"] = record.at_rest;
  json["warnings"] = record.warnings;
  return json;
}

nlohmann::ordered_json accuracy_json(const simulator::ReachedAccuracy& reached) {
  return {{"quantity", "T_z"},
          {"asked", reached.asked},
          {"bias_bound", reached.bias_bound},
          {"noise", number(reached.noise)},
          {"reached", number(reached.reached())},
          {"met", reached.met()}};
}

}  // namespace shakebed::cli
