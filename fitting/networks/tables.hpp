#pragma once

#include <string>
#include <vector>

#include "files/csv.hpp"
#include "fitting/networks/analysis.hpp"

namespace shakebed::fitting::networks {

/// An analysis as CSV tables; `stem` names the file. Lengths and forces in the snapshot's units,
/// `length` and `force`; "d" is the median grain diameter.
struct NamedTable {
  std::string stem;
  files::CsvTable table;
};

/// networks      one row a force network, the largest first
/// contacts      one row a contact with force: places, f, network, strong or not, first pass
/// passes        Table II: one row a pass, and a last one with the networks themselves (pass 0)
/// force_pdf     P(f) of all contacts, of the largest network and of each pass, with the fits
/// force_fits    a, b, beta, theta of every set, form and method, and the published laws
/// correlation   F(r) of each pass and of all contacts
/// missing       contacts that no pass has captured, and why
std::vector<NamedTable> tables(const Snapshot& snapshot, const Analysis& analysis);

/// What an analysis is of and by, for the head of a file.
std::vector<std::string> provenance(const Snapshot& snapshot, const Analysis& analysis);

}  // namespace shakebed::fitting::networks
