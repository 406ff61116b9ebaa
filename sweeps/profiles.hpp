#pragma once

#include <string>
#include <vector>

#include "files/csv.hpp"
#include "simulator/record.hpp"
#include "sweeps/grid.hpp"
#include "sweeps/store/table.hpp"

namespace shakebed::sweeps {

/// Boxes that hold fewer centres than this share of a bed's grains, on average, are left out of the
/// table: the far tail of a hot bed is long and nearly empty.
inline constexpr double least_share_of_grains = 1e-5;

/// Height profiles of a sweep's points in one long table, a row a box of depth d: the axes'
/// columns; W, V_p, layers, grains; z, the height of the box's centre in the lab frame; the centres
/// in the box, its packing fraction phi, and its local temperatures T_c = m(<v_c^2> - <v_c>^2)/2 of
/// that box's grains over all time (Bhateja et al. 2016, Sec. VI), each with its standard error;
/// T_z also as 2 T_z/(m V_p^2); `stationary` and `at_rest` of the point.
///
/// Replicates are combined box by box as in combine.hpp. A temperature is known only where some
/// replicate saw two centres; phi, T_z_instant and the number of centres are 0 where it saw none.
class ProfileTable {
 public:
  explicit ProfileTable(const Grid& grid);
  void add(const Point& point, const std::vector<simulator::Record>& replicates,
           const store::TableRow& combined);
  const files::CsvTable& table() const { return table_; }

 private:
  files::CsvTable table_;
};

}  // namespace shakebed::sweeps
