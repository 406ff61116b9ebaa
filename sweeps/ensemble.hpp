#pragma once

#include <functional>
#include <string>
#include <vector>

#include "simulator/record.hpp"
#include "simulator/scene/scene.hpp"
#include "simulator/simulate.hpp"
#include "sweeps/grid.hpp"
#include "sweeps/progress.hpp"
#include "sweeps/store/cache.hpp"

namespace shakebed::sweeps {

/// What simulates one bed on one thread: simulator::simulate, or a test's own.
using Runner =
    std::function<simulator::Record(const simulator::Scene&, const simulator::RunControl&)>;

struct EnsembleOptions {
  int jobs = 0;                          ///< cores, one a bed; 0: all there are
  std::function<bool()> stop_requested;  ///< polled by every bed; may be empty
  Progress* progress = nullptr;
};

struct RunFailure {
  std::size_t run;  ///< index into the runs
  std::string message;
};

struct EnsembleReport {
  std::size_t cached = 0;  ///< found in the cache
  std::size_t finished = 0;
  std::vector<RunFailure> failures;     ///< in the order of the runs
  std::vector<std::string> made_again;  ///< why cached files could not be used
  bool interrupted = false;
};

/// Simulates every run that the cache lacks: one bed, one task, one thread; dearest first by
/// predicted cost. Where there are more cores than beds, beds in containers share out the rest
/// among them as teams of threads. Records live only until they are written, so at most `jobs` of
/// them exist at once, however many runs there are. What a bed leaves depends on its scene and seed
/// alone, so neither the number of threads nor the order nor an interruption shows in the cache.
///
/// A run that throws is reported, noted in the cache and does not hinder the others. A cache that
/// cannot be written stops everything and throws.
EnsembleReport run_ensemble(const std::vector<Run>& runs, const store::Cache& cache,
                            const Runner& runner, const EnsembleOptions& options);

}  // namespace shakebed::sweeps
