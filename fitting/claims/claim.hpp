#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "files/csv.hpp"
#include "files/yaml.hpp"
#include "fitting/claims/formula.hpp"

namespace shakebed::fitting::claims {

/// A statement of a paper as something to compute: it holds when a number lies in an interval.
struct Claim {
  std::string id;
  std::string says;    ///< the statement, in our words
  std::string source;  ///< "Sec. V, Fig. 11"
  std::string unit;
  std::vector<std::pair<std::string, std::string>> tables;  ///< name in the formula, table's name
  bool steady_only = true;  ///< leave out points at rest or not stationary
  Formula formula;
  std::string formula_text;
  double from;  ///< -infinity: no lower bound
  double to;
  std::string why;  ///< why these bounds
  std::string where;

  std::string bounds_text() const;  ///< "> 1.9", "-20 to -10"
};

/// Reads one entry of `claims:` in the manifest.
Claim read_claim(const files::YamlNode& node);

enum class Verdict { holds, differs, not_decided };
std::string text_of(Verdict verdict);

struct Result {
  double value;           ///< NaN when it could not be computed
  double standard_error;  ///< spread of the value when every cell is redrawn within its error
  Verdict verdict;
  std::string remark;  ///< why it is not decided, if the numbers are missing
};

/// The table of that name, or null when there is none.
using TableSource = std::function<const files::CsvTable*(const std::string&)>;

/// `holds` when the 95 % interval value +- 1.96 standard errors lies within the claim's bounds,
/// `differs` when it lies outside, `not decided` when it crosses one or the numbers are missing.
/// Errors are propagated by 400 draws of a fixed stream, so that the same tables give the same
/// verdict; cells are drawn independently of each other, which overstates the error of a ratio of
/// two averages of one bed.
Result judge(const Claim& claim, const TableSource& tables);

}  // namespace shakebed::fitting::claims
