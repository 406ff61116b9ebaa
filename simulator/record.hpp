#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace shakebed::simulator {

/// A mean over time and its standard error, which accounts for correlation in time.
struct Estimate {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double standard_error = std::numeric_limits<double>::quiet_NaN();
};

/// A measured mean under its name: "T_z" [m g d], "T_z_scaled" [m V_p^2], "h_cm" [d], ...
struct Quantity {
  std::string name;
  std::string unit;
  Estimate estimate;
};

/// A number that is not a mean: "k_n", "time_step", "rest_height", "collisions", ...
struct Scalar {
  std::string name;
  std::string unit;
  double value;
};

/// A time series of averages over `cycles_per_entry` cycles each.
struct Series {
  std::string name;
  std::string unit;
  double cycles_per_entry;
  std::vector<double> values;
};

/// One column of the height profile; entry k belongs to the box of depth `Profile::box_depth`
/// centred at `Profile::z[k]`.
struct ProfileColumn {
  std::string name;
  std::string unit;
  std::vector<double> mean;
  std::vector<double> standard_error;
};

struct Profile {
  double box_depth = 1;   ///< [d]
  std::vector<double> z;  ///< centres of the boxes above the base's mean height [d]
  std::vector<ProfileColumn> columns;
};

/// A contact that presses at the instant of a snapshot. The force is > 0 when it pushes; near its
/// end the dashpot may pull.
struct SnapshotContact {
  static constexpr std::int64_t wall = -1;  ///< j of a contact with the base or another wall

  std::int64_t i;
  std::int64_t j;       ///< > i, or `wall`
  double normal_force;  ///< [m g]
};

/// One instant of a bed. Coordinates are x, y, z; y is 0 in two dimensions, where spin is about y.
struct Snapshot {
  using Triple = std::array<double, 3>;

  std::string name;          ///< "T10.05": the instant asked for [cycles]
  double cycles = 0;         ///< since the base began to move
  double base_height = 0;    ///< displacement of the base from its mean position [d]
  double base_velocity = 0;  ///< [sqrt(g d)]
  Triple period{};           ///< widths of the periodic cell [d]; 0: not periodic in that direction
  std::vector<double> radius;    ///< [d]
  std::vector<Triple> position;  ///< of the centres, wrapped into the periodic cell [d]
  std::vector<Triple> velocity;  ///< [sqrt(g d)]
  std::vector<Triple> spin;      ///< [sqrt(g/d)]; empty when no law turns grains
  std::vector<SnapshotContact> contacts;
  /// More of each contact where its law keeps more than the normal force; else empty.
  std::vector<double> overlap;           ///< [d]
  std::vector<Triple> normal;            ///< from j, or the wall, to i
  std::vector<Triple> tangential_force;  ///< on i [m g]
};

/// Kept apart from the results: these differ from run to run.
struct Timing {
  double cpu_seconds = 0;            ///< the whole run of the bed
  double cpu_seconds_measuring = 0;  ///< the measured cycles alone
  double wall_seconds = 0;
};

/// What one run of one bed leaves behind, plain and in memory. All of it but `timing` depends on
/// the scene, the seed and the physics version alone.
struct Record {
  int physics_version = 0;
  std::uint64_t seed = 0;
  int dimension = 0;
  std::string canonical_scene;  ///< canonical YAML of the scene as understood
  std::vector<Quantity> quantities;
  std::vector<Scalar> scalars;
  std::vector<Series> series;
  Profile profile;
  std::vector<Snapshot> snapshots;
  bool stationary = false;
  std::string stationary_reason;
  bool at_rest = false;
  std::vector<std::string> warnings;
  Timing timing;
};

}  // namespace shakebed::simulator
