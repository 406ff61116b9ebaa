#include "fitting/tables.hpp"

#include "fitting/exponents.hpp"
#include "fitting/tables/head.hpp"

namespace shakebed::fitting {

using files::CsvTable;

constexpr double normal_95 =
    1.96;  ///< half-width of a normal distribution's 95 % [standard errors]

/// `alpha_se` and the 95 % interval are what the points' own errors make of alpha; `scatter_se`
/// is the standard error from the scatter about the line.
CsvTable exponents_table(const Head& head, const FitReport& report) {
  CsvTable table = head.table({{"y", ""},
                               {"alpha", "1"},
                               {"alpha_se", "1"},
                               {"scatter_se", "1"},
                               {"lower95", "1"},
                               {"upper95", "1"},
                               {"low_over_methods", "1"},
                               {"high_over_methods", "1"},
                               {"low_over_ranges", "1"},
                               {"high_over_ranges", "1"},
                               {"low", "1"},
                               {"high", "1"},
                               {"variants", "1"},
                               {"range_column", ""},
                               {"from", ""},
                               {"to", ""},
                               {"range_known", ""},
                               {"first_W", "1"},
                               {"last_W", "1"},
                               {"points", "1"},
                               {"runs_p", "1"},
                               {"reference", "1"},
                               {"reported", "1"},
                               {"reported_error", "1"},
                               {"source", ""}});
  for (const auto& [result, methods, ranges, all, variants, W, error] : exponents(report)) {
    const auto& specification = result->specification;
    const std::size_t alpha = specification.model.nonlinear;
    const auto printed = specification.reference.parameters.find("alpha");
    const bool known = printed != specification.reference.parameters.end();
    head.add(table, *result,
             {specification.y,
              cell(result->fit.values[alpha]),
              cell(error),
              cell(result->fit.standard_error(alpha)),
              cell(result->fit.values[alpha] - normal_95 * error),
              cell(result->fit.values[alpha] + normal_95 * error),
              cell(methods.low),
              cell(methods.high),
              cell(ranges.low),
              cell(ranges.high),
              cell(all.low),
              cell(all.high),
              cell(variants),
              specification.range.column,
              cell(result->range.from),
              cell(result->range.to),
              specification.range.certain ? "given" : "uncertain",
              cell(W.low),
              cell(W.high),
              cell(result->measurements.points.size()),
              cell(result->runs.p_value),
              cell(known ? printed->second.value : unknown),
              cell(specification.reference.reported),
              cell(specification.reference.reported_error),
              specification.reference.source});
  }
  return table;
}

NamedTables tables(const FitFile& file, const FitReport& report, const CsvTable& data) {
  const Head head(report);
  NamedTables all{{"parameters", parameters_table(head, report)},
                  {"summary", summary_table(head, report)},
                  {"exponents", exponents_table(head, report)},
                  {"curves", curves_table(head, report)},
                  {"comparison", comparison_table(head, report)},
                  {"correlations", correlations_table(head, report)},
                  {"collapse", collapse_table(head, report)},
                  {"ratios", ratios_table(file, data)},
                  {"points", points_table(head, report)}};
  for (auto& [name, table] : all) {
    table.provenance = data.provenance;
    table.provenance.push_back("fit: " + file.id);
  }
  return all;
}

std::filesystem::path table_path(const std::filesystem::path& parameters, const std::string& name) {
  if (name == "parameters") return parameters;
  const std::string stem = parameters.stem().string();
  return parameters.parent_path() /
         (stem == "parameters" ? name + ".csv" : stem + "." + name + ".csv");
}

}  // namespace shakebed::fitting
