#include "simulator/record_notes.hpp"

#include <cmath>
#include <cstdio>

#include "simulator/record_lookup.hpp"
#include "simulator/scene/warnings.hpp"

namespace shakebed::simulator {

void write_parameters(Record& record, const Scene& scene, const Parameters& p) {
  const auto& drive = scene.base.drive;
  record.scalars = {{"grains", "1", static_cast<double>(scene.grains.count)},
                    {"layers", "1", scene.grains.layers},
                    {"V_p", "sqrt(g d)", drive.peak_velocity()},
                    {"amplitude", "d", drive.amplitude},
                    {"angular_frequency", "sqrt(g/d)", drive.angular_frequency},
                    {"k_n", "m g/d", p.stiffness},
                    {"time_step", "sqrt(d/g)", p.time_step},
                    {"contact_duration", "sqrt(d/g)", p.contact_duration},
                    {"steps_per_cycle", "1", static_cast<double>(p.steps_per_cycle)}};
  if (scene.gravity > 0) {
    record.scalars.push_back({"W", "1", scene.W()});
    record.scalars.insert(record.scalars.begin() + 2, {"Gamma", "1", scene.Gamma()});
  }
  if (scene.lid) record.scalars.push_back({"lid_height", "d", scene.lid->height});
}

namespace {

const Estimate* estimate_of(const Record& record, const std::string& name) {
  for (const auto& quantity : record.quantities) {
    if (quantity.name == name) return &quantity.estimate;
  }
  return nullptr;
}

/// Grains of a shallow bed that bounce each in its own place, exactly upright, may never meet: a
/// temperature without collisions, ten times that of a bed that has them, and another for another
/// start.
void judge_columns(Record& record, const Scene& scene) {
  constexpr double none = 1e-9;
  const Estimate* T_x = estimate_of(record, "T_x");
  const Estimate* T_z = estimate_of(record, "T_z");
  if (T_x == nullptr || T_z == nullptr || record.at_rest || scene.grains.count < 2) return;
  if (T_x->mean > none * T_z->mean) return;
  record.stationary = false;
  record.stationary_reason =
      "T_x is 0: the grains bounce upright, each in its own place, and never meet; let the base "
      "move before they have settled (protocol.settle: 0), or take more grains";
}

/// Half of what makes a bed not stationary.
void warn_of_ledger(Record& record, const EnergyLedger& ledger) {
  constexpr double doubtful = 0.01;
  if (!record.stationary || record.at_rest) return;
  const double open = std::abs(scalar_of(record, "ledger_residual")) / ledger.dissipation;
  if (!(open > doubtful)) return;
  char text[160];
  std::snprintf(text, sizeof text,
                "the energy ledger is open by %.2g %% of what was dissipated, and T_z off by as "
                "much or more; take a smaller time step",
                100 * open);
  record.warnings.emplace_back(text);
}

void warn_of_softness(Record& record, double largest_overlap, double stiffness) {
  constexpr double soft = 0.1;
  if (largest_overlap <= soft) return;
  char text[240];
  std::snprintf(text, sizeof text,
                "largest overlap %.3g d: contacts this soft change the bed; raise "
                "contact.stiffness (now %.3g m g/d)",
                largest_overlap, stiffness);
  record.warnings.emplace_back(text);
}

}  // namespace

void warn_of_column(Record& record, const Scene& scene, double largest_overlap) {
  record.warnings = column_warnings(bind_column(scene));
  warn_of_softness(record, largest_overlap, scene.column->grain.normal_stiffness);
}

void warn(Record& record, const Scene& scene, const Parameters& p, const EnergyLedger& ledger) {
  char text[240];
  record.warnings = scene_warnings(scene, p);
  warn_of_softness(record, ledger.largest_overlap, p.stiffness);
  judge_columns(record, scene);
  warn_of_ledger(record, ledger);
  if (scene.protocol.until && !record.at_rest) {
    for (const auto& q : record.quantities) {
      const auto& wanted = *scene.protocol.until;
      if (q.name != wanted.quantity) continue;
      const double reached = q.estimate.standard_error / std::abs(q.estimate.mean);
      if (reached <= wanted.fraction) continue;
      std::snprintf(text, sizeof text,
                    "%s is known to %.2g %% after at_most = %ld cycles; %.2g %% was asked for",
                    q.name.c_str(), 100 * reached, scene.protocol.at_most, 100 * wanted.fraction);
      record.warnings.emplace_back(text);
    }
  }
}

}  // namespace shakebed::simulator
