#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fitting/claims/claim.hpp"

namespace shakebed::figures {

/// How far a value may be from the reference before a test objects, and why that far.
struct Tolerance {
  enum class Kind { absolute, relative };
  Kind kind = Kind::relative;
  double value = 0;
  std::string why;
};

/// Where our number for a reference value stands: in a table of the pipeline (a sweep's under its
/// id, a fit's under <id>.<kind>), in the one row whose cells read as `row` says.
struct OurValue {
  std::string table;
  std::vector<std::pair<std::string, std::string>> row;
  std::string column;
};

/// `given` is printed in the paper, `derived` follows from what is printed, `inferred` is our
/// reading of it, `not_given` records that the paper is silent (no value).
struct ReferenceValue {
  std::string name;
  std::optional<double> value;
  std::string unit;
  std::string provenance;
  std::string source;  ///< "Sec. IV", "caption of Fig. 5"
  std::optional<OurValue> ours;
  std::optional<Tolerance> tolerance;  ///< only together with `ours`
  std::string where;                   ///< place in the manifest
};

/// What a figure or table reproduces, and the numbers it is judged by.
struct Entry {
  std::string id;
  std::string paper;  ///< key into Manifest::papers
  std::string item;   ///< "Fig. 2"
  std::string what;
  std::vector<ReferenceValue> values;
  std::vector<fitting::claims::Claim> claims;
};

struct ShippedFile {
  std::filesystem::path path;  ///< relative to the manifest
  std::string sha256;
  std::string made_by;
};

/// data_manifest.yaml: the hand-written part of what is known about figures and shipped data. The
/// list of figures itself comes from their declarations in CMake; a test holds the two together.
struct Manifest {
  std::map<std::string, std::string> papers;  ///< key -> DOI
  /// Profiles whose beds are too small for a paper's statements: they decide nothing.
  std::map<std::string, std::vector<std::string>> shapes_only;
  std::vector<Entry> entries;
  std::vector<ShippedFile> files;

  /// Throws Error(bad_input) naming the manifest when there is no such entry.
  const Entry& entry(const std::string& id) const;

  std::filesystem::path file;
};

/// Throws Error(bad_input) with file:line:column for what is missing, unknown or of wrong type.
Manifest read_manifest(const std::filesystem::path& file);

/// Lower-case hexadecimal SHA-256 of a file's bytes.
std::string sha256_of(const std::filesystem::path& file);

}  // namespace shakebed::figures
