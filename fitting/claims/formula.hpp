#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace shakebed::fitting::claims {

/// What a claim computes, as written in the manifest, for instance
///
///   100 * mean(each(W: 1 - T_z[A = 0.1] / T_z[A = 1]))
///
///   number                     2, 0.5, 1e-6
///   column, table.column       the column's cells in the rows now looked at
///   + - * / and parentheses    cell by cell; one number goes with all cells
///   formula[conditions]        the formula over the rows that meet all of them, `column = word`,
///                              `column = number`, or with != < <= > >=; separated by commas
///   each(column: formula)      the formula (one number) for each value of the column
///   function(formula, ...)     see functions() in evaluate.hpp
struct Condition {
  std::string column;
  std::string comparison;  ///< "=", "!=", "<", "<=", ">", ">="
  std::string value;
};

struct Formula {
  enum class Kind {
    number,
    column,
    negative,
    sum,
    difference,
    product,
    quotient,
    call,
    rows,
    each
  };
  Kind kind = Kind::number;
  double number = 0;
  std::string word{};  ///< column, function, or the column of `each`
  std::vector<Formula> parts{};
  std::vector<Condition> conditions{};
};

/// Throws Error(bad_input) at `where`, saying what was expected after which text.
Formula read_formula(std::string_view text, const std::string& where);

}  // namespace shakebed::fitting::claims
