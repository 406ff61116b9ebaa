#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "files/csv.hpp"
#include "fitting/fit_file.hpp"
#include "fitting/goodness.hpp"

namespace shakebed::fitting {

using Labels = std::vector<std::pair<std::string, std::string>>;  ///< column, value

/// How this fit differs from the first of its entry: the first method, the first weights and the
/// range as written.
struct Variant {
  Method method;
  Weights weights;
  double stretch_from = 1;
  double stretch_to = 1;
  bool is_default = true;
  std::string text() const;  ///< "default", "linear errors", "log_log equal from x0.7"
};

struct FitResult {
  FitSpecification specification;
  Labels labels;
  Variant variant;
  RangeLimits range{};
  Measurements measurements;
  std::vector<double> weights;  ///< of the points
  LeastSquaresFit fit;
  double correlation = 0;
  InformationCriterion criterion{};
  RunsTest runs;
  /// AICc above the best model for the same points, column, method and weights.
  std::optional<double> delta_aicc;
  std::string problem;  ///< why there is no fit; empty when there is one

  bool fitted() const { return problem.empty(); }
};

struct PeakResult {
  PeakSpecification specification;
  Labels labels;
  std::string W_unit;
  std::string y_unit;
  std::optional<Peak> peak;
  std::optional<Settling> settling;
  Curve curve;  ///< the points it was looked for in
  std::vector<DroppedRow> dropped;
  std::string problem;  ///< what could not be found, and why
};

struct FitReport {
  std::vector<FitResult> fits;
  std::vector<PeakResult> peaks;
};

/// Fits everything the file names to the collected table. A fit that cannot be made throws, with
/// its place in the file; with `if_impossible: report`, among the groups of a `for_each` and for
/// variants that stretch the range it is reported as a problem instead. Throws when nothing at all
/// could be fitted.
FitReport run_fits(const FitFile& file, const files::CsvTable& table);

}  // namespace shakebed::fitting
