#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fitting/least_squares.hpp"
#include "fitting/measurements.hpp"
#include "fitting/peak.hpp"

namespace shakebed::fitting {

/// An end of a range: a number, or a word that the data decide. `peak`: the highest measured point
/// of `peak_of`, kept; `W_2`: the first settled point (find_settling); `start`, `end`: all there
/// is.
struct RangeBound {
  enum class Kind { number, peak, W_2, start, end };
  Kind kind;
  double number = 0;
};

struct RangeSpecification {
  std::string column = "W";
  RangeBound from{RangeBound::Kind::start};
  RangeBound to{RangeBound::Kind::end};
  /// Each number and W_2 is also tried times each of these: how far the answer depends on a range
  /// that is not well known.
  std::vector<double> stretch;
  bool certain = true;  ///< false: `known: uncertain`, not printed in the paper
};

/// A value printed in a paper; `half_unit` is half a unit of its last printed digit.
struct PrintedValue {
  double value;
  double half_unit;
};

struct Reference {
  std::map<std::string, PrintedValue> parameters;
  std::optional<double> correlation;
  std::optional<double> reported;  ///< what the earlier study itself reports (Tables I, II)
  std::optional<double> reported_error;
  std::string source;
};

enum class Weights { errors, equal };
enum class Method { linear, log_log };  ///< residuals of y, or of ln y (power law only)

/// What a fit and a search for a peak have in common.
struct DataSpecification {
  std::string id;
  std::string where;  ///< place in the fit file
  RowChoice rows;
  std::vector<std::string> for_each;  ///< one fit for every combination of these columns' values
  std::string y;
  std::string y_error;  ///< empty: none
  std::string peak_of;  ///< the column whose peak and settling bound a range
  SettlingRule settling;
  /// `if_impossible: report` (always so with for_each): a fit the data cannot carry becomes a
  /// problem in the summary. Default `refuse`: an error.
  bool report_problems = false;
};

struct FitSpecification : DataSpecification {
  std::string x;
  Model model;
  std::vector<Method> methods;
  std::vector<Weights> weights;
  Scale scale = Scale::estimated;
  RangeSpecification range;
  Reference reference;
  std::vector<double> compare_at;
};

struct PeakSpecification : DataSpecification {
  PeakRule rule;
};

/// A column made of two others: `of` over `over`, of the same row, or over that of the row that
/// meets `against` and has the same cells in the columns `match`.
struct RatioSpecification {
  std::string id;  ///< the new column's name
  std::string of;
  std::string over;
  std::vector<Filter> against;  ///< empty: the same row
  std::vector<std::string> match;
  std::string where;
};

struct FitFile {
  std::string id;
  std::filesystem::path data;  ///< the collected table; empty when only --data can give it
  std::vector<FitSpecification> fits;
  std::vector<PeakSpecification> peaks;
  std::vector<RatioSpecification> ratios;
};

/// Reads a fit file (schema `fit: 1`); Error(bad_input) with the place for anything wrong.
FitFile read_fit_file(const std::filesystem::path& file);
FitFile read_fit_text(std::string_view text, const std::filesystem::path& file);

}  // namespace shakebed::fitting
