#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "files/csv.hpp"
#include "simulator/scene/read_scene.hpp"
#include "sweeps/ensemble.hpp"
#include "sweeps/grid.hpp"
#include "sweeps/store/cache.hpp"

namespace shakebed::sweeps {

// What accuracy costs: a bed is simulated with its numerical settings changed one at a time, and
// compared with itself at settings that are known to be fine enough.

/// How much a trade study computes. `quick` shows the shape: a few settings, errors five times as
/// large; `shipped` is what data/ holds.
enum class TradeProfile { quick, shipped };
TradeProfile trade_profile(const std::string& word);  ///< throws files::Error(bad_input)

/// One scene under all settings. Columns of the grid: axis, value.
///   reference     k_n as the scene says, contacts in closed form, dt = t_c/50
///   dt stepped    every contact stepped; value is t_c/dt
///   dt closed     isolated contacts in closed form, the others stepped; value is t_c/dt
///   dt uniform    every grain at every step; value is t_c/dt (10: the same beds as `dt stepped`)
///   k_n           times the scene's; value is the factor
///   cycles        measured as many cycles as `value` flights of the bed take
///   replicates    480 flights in all (quick: 120), shared by `value` runs; transients count as
///                 cost
///   pair dashpot at base   c_n of two grains where a grain touches the base; value is the e_w it
///                 makes (a bias of another model, not of a coarse one)
///   cell          lateral widths times value, at the same number of layers
/// Each bed has a seed of its own; the scene's own rule says how long it is measured. A bed in a
/// container has settings of its own (trade_column.hpp). One with a lid or side walls is refused:
/// its engine has none of these choices.
Grid trade_grid(const std::filesystem::path& scene, const std::vector<simulator::Override>& set,
                TradeProfile profile);

/// Only the reference and the axes named; files::Error(bad_input) for one that the grid has not.
void keep_axes(Grid& grid, const std::vector<std::string>& axes);

/// CPU seconds per 1000 measured cycles of every point, the least of `rounds` short runs. All
/// points are timed once before any is timed again, so that a slow spell of the machine meets all.
std::vector<double> time_in_turns(const std::vector<simulator::Scene>& scenes, int rounds,
                                  const Runner& runner);

/// One row a setting: the scene's name and numbers; axis and value; T_z, T_x and h_cm with errors;
/// their bias [%] against the reference (for k_n: against the hardest), with its error; CPU seconds
/// per 1000 cycles; cycles for a standard error of T_z of 1 %, and what these cost.
files::CsvTable trade_table(const std::string& scene, const Grid& grid,
                            const files::CsvTable& collected, const std::vector<double>& seconds);

/// Appends the rows of a table with the same columns.
void append_rows(files::CsvTable& table, const files::CsvTable& more);

}  // namespace shakebed::sweeps
