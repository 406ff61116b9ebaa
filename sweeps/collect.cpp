#include "sweeps/collect.hpp"

#include <algorithm>
#include <cmath>

#include "sweeps/cached_runs.hpp"
#include "sweeps/combine.hpp"
#include "sweeps/cost_model.hpp"
#include "sweeps/profiles.hpp"
#include "sweeps/store/table.hpp"

namespace shakebed::sweeps {
namespace {

void drop_what_the_point_says(store::TableRow& row) {
  std::erase_if(row.scalars, [&](const simulator::Scalar& scalar) {
    for (const auto& known : row.point) {
      if (known.name == scalar.name) return true;
    }
    return false;
  });
}

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
  CachedRuns reader(grid, cache);
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
  CachedRuns reader(grid, cache);
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
      status.spent_cpu_seconds += found.run->record.timing.cpu_seconds;
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
