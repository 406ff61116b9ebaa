#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace shakebed::figures {

/// Rows whose `column` holds one of `words`, compared as written in the table.
struct Filter {
  std::string column;
  std::vector<std::string> words;
  std::string where;  ///< "fig02.yaml:12:7"
};

/// A column taken over as it is, under a new name if `as` differs. A printed table rounds its
/// numbers to `digits` significant ones; the CSV never does.
struct CopiedColumn {
  std::string column;
  std::string as;
  std::optional<int> digits;
};

/// A column of words made from two columns of fractions of replicates: "steady", "at rest",
/// "not stationary", or "missing" where a fraction is missing.
struct StateColumn {
  std::string stationary;
  std::string at_rest;
  std::string as = "state";
};

struct PartColumn {
  std::variant<CopiedColumn, StateColumn> kind;
  std::string where;
};

/// Tables given by name on the command line, one below the other (equal headers).
struct NamedTables {
  std::vector<std::string> names;
};
/// A hand-written CSV that lies with the repository.
struct TableFile {
  std::filesystem::path file;
};
/// One CSV of the figure: where its rows come from, which of them, which columns.
struct Part {
  std::string name;   ///< "points"; the script finds its file and columns under this name
  std::string title;  ///< heading in a printed table
  std::variant<NamedTables, TableFile> source;
  std::vector<Filter> filters;
  std::vector<PartColumn> columns;  ///< empty: all of them
  std::string where;
};

/// What one figure or table is made of. Read from YAML (schema `figure: 1`), a picture when
/// it has a script, otherwise a printed table.
struct Specification {
  std::string id;
  std::string title;
  std::filesystem::path script;        ///< gnuplot script; empty for a printed table
  std::pair<int, int> size{900, 600};  ///< of the picture [px]
  std::vector<Part> parts;             ///< the first is written as <id>.csv
  std::vector<std::string> notes;      ///< below a printed table

  bool is_picture() const { return !script.empty(); }
  /// Names of all tables that must be given on the command line, each once.
  std::vector<std::string> table_names() const;
};

/// Throws Error(bad_input) with file:line:column for what is missing, unknown or of wrong type.
Specification read_specification(const std::filesystem::path& file);

}  // namespace shakebed::figures
