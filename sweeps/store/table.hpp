#pragma once

#include <string>
#include <vector>

#include "files/csv.hpp"
#include "simulator/record.hpp"

namespace shakebed::sweeps::store {

/// What the runs of one point of a sweep come to.
struct TableRow {
  std::vector<std::string> axis_cells;          ///< one a column of the axes
  std::vector<simulator::Scalar> point;         ///< W, Gamma, ...: known without any run
  std::vector<simulator::Quantity> quantities;  ///< means over replicates
  std::vector<simulator::Scalar> scalars;
  double stationary_fraction = 0;  ///< share of the replicates that are stationary
  double at_rest_fraction = 0;
  int replicates = 0;  ///< how many runs the row rests on; 0: the point has not been run
  double cycles = 0;   ///< measured, over all replicates
  std::string reason;  ///< what a reader of the row must know; empty when all is well
};

/// The collected table: axis columns, point columns, `NAME [unit]` and `NAME_se [unit]` for every
/// quantity, scalars, then stationary, at_rest, replicates, cycles, reason. Columns are the union
/// over the rows in order of first appearance; what a row lacks is an empty cell. An axis column
/// stands in for a point column or scalar of its name, and may not have a quantity's.
files::CsvTable collected_table(const std::vector<files::CsvColumn>& axis_columns,
                                const std::vector<TableRow>& rows);

}  // namespace shakebed::sweeps::store
