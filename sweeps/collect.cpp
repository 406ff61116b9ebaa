#include "sweeps/collect.hpp"

#include <set>

#include "simulator/simulate.hpp"
#include "sweeps/combine.hpp"
#include "sweeps/cost_model.hpp"
#include "sweeps/store/run_key.hpp"
#include "sweeps/store/table.hpp"

namespace shakebed::sweeps {
namespace {

/// What is known of a point without running it.
std::vector<simulator::Scalar> point_scalars(const simulator::Scene& scene) {
  return {{"W", "1", scene.W()},
          {"Gamma", "1", scene.Gamma()},
          {"V_p", "sqrt(g d)", scene.base.drive.peak_velocity()},
          {"layers", "1", scene.grains.layers},
          {"grains", "1", static_cast<double>(scene.grains.count)}};
}

void drop_what_the_point_says(store::TableRow& row) {
  std::erase_if(row.scalars, [&](const simulator::Scalar& scalar) {
    for (const auto& known : row.point) {
      if (known.name == scalar.name) return true;
    }
    return false;
  });
}

/// Sorted and joined: the same for any order of the runs.
std::string joined(const std::set<std::string>& texts) {
  std::string all;
  for (const auto& text : texts) all += (all.empty() ? "" : ", ") + text;
  return all.empty() ? "none" : all;
}

/// Who made the runs of a table.
struct Makers {
  std::set<std::string> revisions;
  std::set<std::string> machines;
  std::set<std::string> flags;
  void add(const store::Provenance& provenance) {
    revisions.insert(provenance.git_revision);
    machines.insert(provenance.machine);
    flags.insert(provenance.compiler + " " + provenance.compiler_flags);
  }
};

std::vector<std::string> provenance_lines(const Grid& grid, const Collected& collected,
                                          const Makers& makers, const std::string& all_keys) {
  std::vector<std::string> lines{"sweep: " + grid.id,
                                 "profile: " + grid.profile,
                                 "physics version: " + std::to_string(simulator::physics_version),
                                 "git revision: " + joined(makers.revisions),
                                 "machine: " + joined(makers.machines),
                                 "compiler: " + joined(makers.flags),
                                 "points: " + std::to_string(grid.points.size()) +
                                     ", runs: " + std::to_string(collected.runs_present),
                                 "digest of the run keys: " + store::digest(all_keys)};
  if (collected.runs_missing > 0) {
    lines.push_back("incomplete: " + std::to_string(collected.runs_missing) + " runs are missing");
  }
  return lines;
}

}  // namespace

Collected collect(const Grid& grid, const store::Cache& cache) {
  Collected collected;
  Makers makers;
  std::string all_keys;
  std::vector<store::TableRow> rows;
  const std::vector<Run> runs = runs_of(grid);
  for (std::size_t first = 0; first < runs.size(); first += grid.replicates) {
    std::vector<simulator::Record> replicates;
    for (int replicate = 0; replicate < grid.replicates; ++replicate) {
      const Run& run = runs[first + replicate];
      all_keys += run.identity.key;
      auto found = cache.find(run.identity);
      if (found.run) {
        makers.add(found.run->provenance);
        replicates.push_back(std::move(found.run->record));
      } else if (!found.problem.empty()) {
        collected.problems.push_back(found.problem);
      }
    }
    collected.runs_present += replicates.size();
    collected.runs_missing += grid.replicates - replicates.size();
    const Point& point = grid.points[runs[first].point];
    store::TableRow row = combine_records(replicates);
    if (replicates.empty()) row.reason = "not run";
    row.axis_cells = point.labels;
    row.point = point_scalars(point.scene);
    drop_what_the_point_says(row);
    rows.push_back(std::move(row));
  }
  collected.table = store::collected_table(grid.columns, rows);
  collected.table.provenance = provenance_lines(grid, collected, makers, all_keys);
  return collected;
}

Status status_of(const Grid& grid, const store::Cache& cache) {
  Status status;
  for (const Run& run : runs_of(grid)) {
    const auto found = cache.find(run.identity);
    if (found.run) {
      ++status.cached;
      continue;
    }
    ++status.missing;
    status.predicted_cpu_seconds += predicted_cpu_seconds(run.scene);
    if (!found.problem.empty()) status.problems.push_back(found.problem);
    if (const auto message = cache.failure_of(run.identity.key)) {
      ++status.failed;
      status.failures.push_back(grid.describe(grid.points[run.point]) + ": " + *message);
    }
  }
  return status;
}

}  // namespace shakebed::sweeps
