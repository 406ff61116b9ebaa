#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "files/csv.hpp"
#include "sweeps/grid.hpp"
#include "sweeps/store/cache.hpp"

namespace shakebed::sweeps {

struct Collected {
  files::CsvTable table;     ///< one row a point, in the grid's order
  files::CsvTable profiles;  ///< one row a box of a point (profiles.hpp), when asked for
  std::size_t runs_present = 0;
  std::size_t runs_missing = 0;
  std::vector<std::string> problems;  ///< cached files that cannot be used
};

/// Reads the cache and combines the replicates of each point, one point at a time. A point without
/// any run keeps its row, with empty cells and `replicates` 0. Never runs a bed.
enum class With { averages, averages_and_profiles };
Collected collect(const Grid& grid, const store::Cache& cache, With with = With::averages);

/// One row a grain of every snapshot in the cached runs: the axes' cells, W, Gamma, V_p, layers,
/// grains, the replicate, the snapshot's name, cycles and base height,
/// then the grain's id, x, y, z, radius, v_x, v_y, v_z and speed over V_p. Points without
/// snapshots have no rows; a sweep none of whose points has any is files::Error(bad_input).
Collected collect_snapshots(const Grid& grid, const store::Cache& cache);

struct Status {
  std::size_t cached = 0;
  std::size_t missing = 0;            ///< never run, interrupted, or not usable
  std::size_t failed = 0;             ///< tried and failed; part of the missing
  double predicted_cpu_seconds = 0;   ///< of the missing
  double spent_cpu_seconds = 0;       ///< by the cached, on the machines that ran them
  std::vector<std::string> failures;  ///< point and message
  std::vector<std::string> problems;
};

Status status_of(const Grid& grid, const store::Cache& cache);

}  // namespace shakebed::sweeps
