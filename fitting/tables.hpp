#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "files/csv.hpp"
#include "fitting/fit.hpp"

namespace shakebed::fitting {

/// What a fit leaves behind, all numbers computed, ready to be drawn or printed:
///  parameters   one row a parameter (also W_f, peak_height and W_2 of every peak)
///  summary      one row a fit: range, points, chi^2/dof, correlation coefficient, AIC, runs test
///  exponents    one row a power law: alpha by the default rule, its errors from the points'
///               own and from the scatter about the line, and its spread over the other rules
///  curves       every fitted curve, its 95 % band and the paper's curve on a fine grid
///  comparison   our curve against the paper's at the places the fit file names
///  correlations between the parameters of a fit
///  collapse     the points of every peak's curve over W_f and over the peak's height
///  ratios       the columns named under `ratios`, for every row of the collected table
///  points       every row of the selection: used, with its residual, or dropped, with the reason
/// An empty interval end means that the data do not bound the parameter there.
using NamedTables = std::vector<std::pair<std::string, files::CsvTable>>;
NamedTables tables(const FitFile& file, const FitReport& report, const files::CsvTable& data);

/// Where `tables` go when the parameters go to `parameters`: beside it, as summary.csv, ... when
/// that is called parameters.csv, otherwise as <its stem>.summary.csv, ...
std::filesystem::path table_path(const std::filesystem::path& parameters, const std::string& name);

/// The report for a reader: fits with the paper's numbers beside ours, exponents, peaks, and what
/// was left out.
std::string readable(const FitReport& report);

}  // namespace shakebed::fitting
