#pragma once

#include "files/csv.hpp"

namespace shakebed::tests {

/// A collected table with the columns of the canonical sweep, made from formulas and not from beds:
/// the decay printed in Table III for the rough systems (and a steeper one for the smooth), a
/// linear rise from the onset to the peak, rest below the onset, errors of 1 % and deterministic
/// scatter of that size. The rough beds at W = 1.397 are marked as not stationary.
files::CsvTable synthetic_canonical_table();

}  // namespace shakebed::tests
