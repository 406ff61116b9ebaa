#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "figures/specification.hpp"
#include "files/csv.hpp"

namespace shakebed::figures {

using Tables = std::map<std::string, files::CsvTable>;

/// The CSV of one part: rows picked by its filters, columns picked and renamed. No number is
/// changed: cells are copied as text. `tables` are those given on the command line. Throws
/// Error(bad_input) naming the specification's line when a table, a column or every row is missing.
files::CsvTable assemble(const Part& part, const Tables& tables);

/// "steady", "at rest", "not stationary" or "missing", for the fractions of replicates that were
/// stationary and at rest. One replicate that is not stationary, or that moves where another has
/// come to rest, marks the point as not stationary.
std::string state_of_point(double stationary, double at_rest);

}  // namespace shakebed::figures
