#include "sweeps/collect.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "simulator/simulate.hpp"
#include "sweeps/combine.hpp"
#include "sweeps/cost_model.hpp"
#include "sweeps/profiles.hpp"
#include "sweeps/store/run_key.hpp"
#include "sweeps/store/table.hpp"

namespace shakebed::sweeps {
namespace {

/// What is known of a point without running it.
std::vector<simulator::Scalar> point_scalars(const simulator::Scene& scene) {
  const double v = scene.base.drive.peak_velocity();
  std::vector<simulator::Scalar> scalars{
      {"W", "1", scene.W()},
      {"Gamma", "1", scene.Gamma()},
      {"V_p", "sqrt(g d)", v},
      {"layers", "1", scene.grains.layers},
      {"grains", "1", static_cast<double>(scene.grains.count)}};
  // Without gravity there is no W; V_p^2/(d g) with the unit g is still an abscissa.
  if (scene.gravity == 0) scalars.push_back({"W_nominal", "1", v * v});
  return scalars;
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

/// The cached records of one point, replicate by replicate; what is missing is counted.
class Reader {
 public:
  Reader(const Grid& grid, const store::Cache& cache)
      : grid_(grid), cache_(cache), runs_(runs_of(grid)) {}

  std::size_t points() const { return grid_.points.size(); }
  const Point& point(std::size_t k) const { return grid_.points[runs_[first_run(k)].point]; }

  std::vector<simulator::Record> records(std::size_t point, Collected& collected) {
    std::vector<simulator::Record> found_records;
    const auto replicates = static_cast<std::size_t>(grid_.replicates);
    for (std::size_t replicate = 0; replicate < replicates; ++replicate) {
      const Run& run = runs_[first_run(point) + replicate];
      all_keys_ += run.identity.key;
      auto found = cache_.find(run.identity);
      if (found.run) {
        makers_.add(found.run->provenance);
        found_records.push_back(std::move(found.run->record));
      } else if (!found.problem.empty()) {
        collected.problems.push_back(found.problem);
      }
    }
    collected.runs_present += found_records.size();
    collected.runs_missing += replicates - found_records.size();
    return found_records;
  }

  std::vector<std::string> provenance(const Collected& collected) const {
    return provenance_lines(grid_, collected, makers_, all_keys_);
  }

 private:
  std::size_t first_run(std::size_t point) const {
    return point * static_cast<std::size_t>(grid_.replicates);
  }

  const Grid& grid_;
  const store::Cache& cache_;
  std::vector<Run> runs_;
  Makers makers_;
  std::string all_keys_;
};

const std::vector<files::CsvColumn> grain_columns{{"snapshot", ""},     {"snapshot_cycles", "1"},
                                                  {"base_height", "d"}, {"id", "1"},
                                                  {"x", "d"},           {"y", "d"},
                                                  {"z", "d"},           {"radius", "d"},
                                                  {"v_x", "sqrt(g d)"}, {"v_y", "sqrt(g d)"},
                                                  {"v_z", "sqrt(g d)"}, {"speed", "V_p"}};

void add_grain_rows(files::CsvTable& table, const std::vector<std::string>& point_cells,
                    const simulator::Snapshot& snapshot, double peak_velocity) {
  using files::number_text;
  for (std::size_t i = 0; i < snapshot.position.size(); ++i) {
    auto cells = point_cells;
    cells.insert(cells.end(), {snapshot.name, number_text(snapshot.cycles),
                               number_text(snapshot.base_height), std::to_string(i)});
    for (const double x : snapshot.position[i]) cells.push_back(number_text(x));
    cells.push_back(number_text(snapshot.radius[i]));
    const auto& v = snapshot.velocity[i];
    for (const double component : v) cells.push_back(number_text(component));
    cells.push_back(number_text(std::hypot(v[0], v[1], v[2]) / peak_velocity));
    table.add_row(std::move(cells));
  }
}

}  // namespace

Collected collect(const Grid& grid, const store::Cache& cache, With with) {
  Collected collected;
  ProfileTable profiles(grid);
  Reader reader(grid, cache);
  std::vector<store::TableRow> rows;
  for (std::size_t k = 0; k < reader.points(); ++k) {
    const auto replicates = reader.records(k, collected);
    store::TableRow row = combine_records(replicates);
    if (replicates.empty()) row.reason = "not run";
    if (with == With::averages_and_profiles) profiles.add(reader.point(k), replicates, row);
    row.axis_cells = reader.point(k).labels;
    row.point = point_scalars(reader.point(k).scene);
    drop_what_the_point_says(row);
    rows.push_back(std::move(row));
  }
  collected.table = store::collected_table(grid.columns, rows);
  collected.table.provenance = reader.provenance(collected);
  if (with == With::averages_and_profiles) {
    collected.profiles = profiles.table();
    collected.profiles.provenance = collected.table.provenance;
  }
  return collected;
}

Collected collect_snapshots(const Grid& grid, const store::Cache& cache) {
  Collected collected;
  Reader reader(grid, cache);
  auto columns = grid.columns;
  const auto taken = [&grid](const simulator::Scalar& scalar) {
    return std::any_of(grid.columns.begin(), grid.columns.end(),
                       [&](const auto& column) { return column.name == scalar.name; });
  };
  for (const auto& scalar : point_scalars(grid.points.front().scene)) {
    if (taken(scalar) || scalar.name == "W_nominal") continue;
    columns.push_back({scalar.name, scalar.unit});
  }
  columns.push_back({"replicate", "1"});
  columns.insert(columns.end(), grain_columns.begin(), grain_columns.end());
  files::CsvTable table(columns);
  bool asked_for = false;
  for (std::size_t k = 0; k < reader.points(); ++k) {
    const auto& scene = reader.point(k).scene;
    asked_for = asked_for || !scene.protocol.snapshots.phases.empty();
    auto cells = reader.point(k).labels;
    for (const auto& scalar : point_scalars(scene)) {
      if (taken(scalar) || scalar.name == "W_nominal") continue;
      cells.push_back(std::isfinite(scalar.value) ? files::number_text(scalar.value) : "");
    }
    const auto replicates = reader.records(k, collected);
    for (std::size_t r = 0; r < replicates.size(); ++r) {
      auto point_cells = cells;
      point_cells.push_back(std::to_string(r + 1));
      for (const auto& snapshot : replicates[r].snapshots) {
        add_grain_rows(table, point_cells, snapshot, scene.base.drive.peak_velocity());
      }
    }
  }
  if (!asked_for) {
    throw files::bad_input(grid.id,
                           "no point's scene asks for snapshots; give it "
                           "protocol.snapshots: {phases: [0]}");
  }
  collected.table = std::move(table);
  collected.table.provenance = reader.provenance(collected);
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
