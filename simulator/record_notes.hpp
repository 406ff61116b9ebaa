#pragma once

#include "simulator/contact/parameters.hpp"
#include "simulator/observables/energy_ledger.hpp"
#include "simulator/record.hpp"
#include "simulator/scene/scene.hpp"

namespace shakebed::simulator {

/// What was bound before the run: drive, stiffness, time step.
void write_parameters(Record& record, const Scene& scene, const Parameters& p);

/// What a user should know of a run that went through: what the scene itself warns of, soft
/// contacts met, an error above the one asked for.
void warn(Record& record, const Scene& scene, const Parameters& p, const EnergyLedger& ledger);

/// The same of a bed in a container.
void warn_of_column(Record& record, const Scene& scene, double largest_overlap);

}  // namespace shakebed::simulator
