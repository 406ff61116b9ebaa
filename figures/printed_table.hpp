#pragma once

#include <string>
#include <vector>

#include "figures/specification.hpp"
#include "files/csv.hpp"

namespace shakebed::figures {

/// The parts of a printed table one below the other, numbers rounded as the specification says,
/// with its notes: for a terminal, and as Markdown. `tables` are the assembled parts, in order.
std::string as_text(const Specification& specification, const std::vector<files::CsvTable>& tables);
std::string as_markdown(const Specification& specification,
                        const std::vector<files::CsvTable>& tables);

}  // namespace shakebed::figures
