#include "sweeps/cached_runs.hpp"

#include "simulator/simulate.hpp"
#include "sweeps/store/run_key.hpp"

namespace shakebed::sweeps {
namespace {

/// Sorted and joined: the same for any order of the runs.
std::string joined(const std::set<std::string>& texts) {
  std::string all;
  for (const auto& text : texts) all += (all.empty() ? "" : ", ") + text;
  return all.empty() ? "none" : all;
}

}  // namespace

std::vector<simulator::Scalar> point_scalars(const simulator::Scene& scene) {
  const double v = scene.base.drive.peak_velocity();
  std::vector<simulator::Scalar> scalars{{"W", "1", scene.W()},
                                         {"Gamma", "1", scene.Gamma()},
                                         {"V_p", "sqrt(g d)", v},
                                         {"layers", "1", scene.grains.layers},
                                         {"grains", "1", static_cast<double>(scene.grains.count)}};
  // Without gravity there is no W; V_p^2/(d g) with the unit g is still an abscissa.
  if (scene.gravity == 0) scalars.push_back({"W_nominal", "1", v * v});
  return scalars;
}

std::vector<simulator::Record> CachedRuns::records(std::size_t point, Collected& collected) {
  std::vector<simulator::Record> found_records;
  const auto replicates = static_cast<std::size_t>(grid_.replicates_of(grid_.points[point]));
  for (std::size_t replicate = 0; replicate < replicates; ++replicate) {
    const Run& run = runs_[first_run_[point] + replicate];
    all_keys_ += run.identity.key;
    auto found = cache_.find(run.identity);
    if (found.run) {
      const auto& by = found.run->provenance;
      revisions_.insert(by.git_revision);
      machines_.insert(by.machine);
      flags_.insert(by.compiler + " " + by.compiler_flags);
      found_records.push_back(std::move(found.run->record));
    } else if (!found.problem.empty()) {
      collected.problems.push_back(found.problem);
    }
  }
  collected.runs_present += found_records.size();
  collected.runs_missing += replicates - found_records.size();
  return found_records;
}

std::vector<std::string> CachedRuns::provenance(const Collected& collected) const {
  std::vector<std::string> lines{"sweep: " + grid_.id,
                                 "profile: " + grid_.profile,
                                 "physics version: " + std::to_string(simulator::physics_version),
                                 "git revision: " + joined(revisions_),
                                 "machine: " + joined(machines_),
                                 "compiler: " + joined(flags_),
                                 "points: " + std::to_string(grid_.points.size()) +
                                     ", runs: " + std::to_string(collected.runs_present),
                                 "digest of the run keys: " + store::digest(all_keys_)};
  if (collected.runs_missing > 0) {
    lines.push_back("incomplete: " + std::to_string(collected.runs_missing) + " runs are missing");
  }
  return lines;
}

}  // namespace shakebed::sweeps
