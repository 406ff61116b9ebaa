#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "files/csv.hpp"
#include "simulator/scene/scene.hpp"
#include "sweeps/store/cache.hpp"

namespace shakebed::sweeps {

/// One point of the grid: a scene, and where it lies on the axes.
struct Point {
  std::vector<std::string> labels;  ///< one a column of the axes
  simulator::Scene scene;           ///< with the base scene's seed
  int replicates = 0;               ///< 0: as many as the grid's
};

/// A sweep file with one of its profiles, expanded.
struct Grid {
  std::string id;
  std::string profile;
  std::vector<files::CsvColumn> columns;  ///< of the axes
  std::vector<Point> points;              ///< the last axis runs fastest
  int replicates = 1;
  bool seed_is_an_axis = false;  ///< then seeds are the axis' own

  int replicates_of(const Point& point) const {
    return point.replicates > 0 ? point.replicates : replicates;
  }
  /// "system = 3D rough, frequency_rpm = 300"
  std::string describe(const Point& point) const;
};

/// Reads a sweep (schema 1):
///   sweep: 1
///   id: bhateja2016-canonical
///   base: scene.yaml                  # relative to this file
///   set: {protocol.measure.at_most: 1000}
///   axes: [...]                       # crossed; see axis.hpp
///   replicates: 2
///   profiles:
///     quick: {set: {...}, axes: {frequency_rpm: [300, 1000]}, replicates: 1, points: [...]}
/// A sweep without profiles is the same under any. Keys of single points (point_rule.hpp) go over
/// values of axes, those over the profile's `set`, and those over the sweep's. All faults come as
/// one files::Error(bad_input), each with its place.
Grid read_grid(const std::filesystem::path& sweep, const std::string& profile);

/// One bed to simulate: a point with a replicate's seed.
struct Run {
  std::size_t point;
  int replicate;
  simulator::Scene scene;
  store::RunIdentity identity;
};

/// Depends on the point's own scene (its base seed included) and on the replicate only, so that it
/// stays the same when axes are reordered or points added; of a bed in a container on what its
/// packing depends on, so that points which differ in drive, drag, step or friction start from the
/// same packing. Below 2^53, so that every reader of JSON and CSV gets it exactly.
std::uint64_t replicate_seed(const simulator::Scene& point, int replicate);

/// All runs, replicates of a point side by side.
std::vector<Run> runs_of(const Grid& grid);

}  // namespace shakebed::sweeps
