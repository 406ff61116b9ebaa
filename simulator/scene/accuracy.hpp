#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulator/record.hpp"
#include "simulator/scene/scene.hpp"
#include "simulator/scene/values.hpp"

namespace shakebed::simulator {

// Scenes that say how accurate T_z is to be, and not how finely to compute:
//   accuracy: standard        or        accuracy: {T_z: 1 %}
// The promise is a 95 % bound on the whole error, |bias| + 1.96 standard errors. What a setting's
// bias is bounded by has been measured (docs/accuracy.md, data/trade).

/// One value of a numerical setting.
struct AccuracySetting {
  double value;          ///< t_c/dt, or k_n over that of `stiffness: auto`
  double bias_bound;     ///< on |bias of T_z|, as a share
  double relative_cost;  ///< CPU time beside t_c/dt = 50 and k_n of `auto`
};

/// The rows of data/trade/accuracy.csv, as they were when the program was configured.
struct AccuracyTable {
  std::vector<AccuracySetting> steps;
  std::vector<AccuracySetting> stiffness;
};
const AccuracyTable& accuracy_table();

struct AccuracyChoice {
  double steps_in_contact;                 ///< t_c/dt
  std::optional<double> stiffness_factor;  ///< empty: the scene's own k_n stays
  double bias_bound;
  double standard_error;  ///< share of T_z to which noise is reduced

  double promise() const { return bias_bound + 1.96 * standard_error; }
};

/// The cheapest settings that keep |bias| + 1.96 standard errors below `bound`: cost goes as the
/// settings' times 1/(bound - bias)^2. Empty when the table has none with less bias than that.
std::optional<AccuracyChoice> choose_accuracy(double bound, bool stiffness_given);

/// draft, standard and reference: fixed settings, whose promise the table makes.
AccuracyChoice accuracy_preset(const std::string& word, bool stiffness_given);

/// Reads `accuracy` and puts time step, k_n and the measuring rule in its place.
void read_accuracy(SceneValues& values, Scene& scene);

/// Why a scene lies outside the beds the bounds were measured on; empty when it does not.
std::string outside_calibration(const Scene& scene);

/// What a run of a scene with `accuracy` came to.
struct ReachedAccuracy {
  double asked;       ///< share of T_z
  double bias_bound;  ///< share of T_z
  double noise;       ///< 1.96 standard errors, share of T_z
  bool at_rest;       ///< T_z vanishes and has no relative error
  double reached() const { return at_rest ? 0 : bias_bound + noise; }
  bool met() const { return at_rest || reached() <= asked * (1 + 1e-9); }
};
std::optional<ReachedAccuracy> reached_accuracy(const Scene& scene, const Record& record);

}  // namespace shakebed::simulator
