#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "figures/manifest.hpp"
#include "files/csv.hpp"
#include "fitting/claims/claim.hpp"

namespace shakebed::figures {

/// The pipeline's tables of each origin (shipped, quick, paper), as CMake lists them in tables.csv.
/// Read when asked for; one that has not been made is not there.
class PipelineTables {
 public:
  explicit PipelineTables(const std::filesystem::path& list);
  const files::CsvTable* find(const std::string& origin, const std::string& table) const;
  /// Whether any table of that origin has been made.
  bool any(const std::string& origin) const;

 private:
  using Name = std::pair<std::string, std::string>;  ///< origin, table
  std::map<Name, std::filesystem::path> files_;
  mutable std::map<Name, files::CsvTable> read_;
};

/// A claim of the manifest with its verdict from the tables of each origin.
struct JudgedClaim {
  std::string figure;
  const fitting::claims::Claim* claim;
  std::map<std::string, fitting::claims::Result> results;  ///< by origin
};

/// Every claim of the manifest over each of `origins`; arithmetic is fitting's.
std::vector<JudgedClaim> judge_claims(const Manifest& manifest, const PipelineTables& tables,
                                      const std::vector<std::string>& origins);

/// Verdicts to keep: figure, claim, value, standard_error, verdict, from the shipped averages.
files::CsvTable recorded_verdicts(const std::vector<JudgedClaim>& judged);

/// Claims whose verdict is not the recorded one, and claims that are recorded but gone or new:
/// "bhateja2016-fig11/dashed-fall: recorded holds, now differs".
std::vector<std::string> changes_since(const files::CsvTable& recorded,
                                       const std::vector<JudgedClaim>& judged);

/// All of it as one table, and for a reader.
files::CsvTable claims_table(const std::vector<JudgedClaim>& judged);
std::string claims_text(const std::vector<JudgedClaim>& judged);

}  // namespace shakebed::figures
