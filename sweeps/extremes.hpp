#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "files/csv.hpp"
#include "simulator/record.hpp"
#include "sweeps/grid.hpp"

namespace shakebed::sweeps {

// Where the numbers end to mean something: scenes at the ends of every range, run to failure.

/// One scene of a list, as understood; or why it was refused.
struct ExtremeCase {
  std::string id;
  std::string group;                      ///< what is extreme about it
  std::optional<std::string> against;     ///< id of the case whose T_z it must have ...
  double within = 0;                      ///< ... to this share
  std::optional<simulator::Scene> scene;  ///< empty: refused
  std::string refusal;
  std::string failure;  ///< why it stopped on the way
};

/// Reads a list (schema 1):
///   extremes: 1
///   id: extremes
///   base: scene.yaml                # relative to this file
///   cases:
///     - {group: restitution, id: "e = 0.01", set: {grains.restitution: 0.01}}
///     - {group: time step, id: "dt = t_c/3", set: {...}, against: standard, within: 5 %}
/// `scene:` beside `set:` takes another file in place of `base`. Faults of the list itself are
/// files::Error(bad_input); faults of its scenes are refusals, which the list is there to show.
struct ExtremeList {
  std::string id;
  std::vector<ExtremeCase> cases;
};
ExtremeList read_extremes(const std::filesystem::path& list);

/// The runs of all cases that were not refused; Run::point is the index of the case.
std::vector<Run> runs_of(const ExtremeList& list);

/// right         ran, its ledger closes to 1 %, and it has the T_z it must have
/// wrong, said   it does not, and the record says so: a warning, or not stationary
/// wrong, UNSAID it does not, and nothing is said: a defect
/// stopped, said it ended with an error on the way
/// refused       an error before it ran
/// no steady state, said: what it says about being stationary is the answer
/// One row a case; `says` is the refusal, or what the record warns of.
files::CsvTable extremes_table(const ExtremeList& list,
                               const std::vector<std::optional<simulator::Record>>& records);

}  // namespace shakebed::sweeps
