#include "fitting/claims/evaluate.hpp"

#include <algorithm>
#include <cmath>

#include "files/error.hpp"
#include "files/yaml.hpp"
#include "fitting/claims/functions.hpp"

namespace shakebed::fitting::claims {
namespace {

using files::CsvTable;
using Kind = Formula::Kind;

bool steady(const CsvTable& table, std::size_t row) {
  if (!table.has_column("stationary") || !table.has_column("at_rest")) return true;
  return table.number(row, table.column("stationary")) == 1 &&
         table.number(row, table.column("at_rest")) == 0;
}

bool meets(const std::string& cell, const Condition& condition) {
  const auto a = files::number_from_text(cell);
  const auto b = files::number_from_text(condition.value);
  const auto& sign = condition.comparison;
  if (!a || !b) {
    if (sign == "=") return cell == condition.value;
    return sign == "!=" && cell != condition.value;
  }
  const bool equal = std::abs(*a - *b) <= 1e-9 * std::max(std::abs(*a), std::abs(*b));
  if (sign == "=") return equal;
  if (sign == "!=") return !equal;
  if (sign == "<") return *a < *b && !equal;
  if (sign == "<=") return *a < *b || equal;
  if (sign == ">") return *a > *b && !equal;
  return *a > *b || equal;
}

std::string text_of(const std::vector<Condition>& conditions) {
  std::string text;
  for (const auto& [column, sign, value] : conditions) {
    text += (text.empty() ? "" : ", ") + column + " " + sign + " " + value;
  }
  return text;
}

double combined(Kind kind, double a, double b) {
  switch (kind) {
    case Kind::sum:
      return a + b;
    case Kind::difference:
      return a - b;
    case Kind::product:
      return a * b;
    default:
      return a / b;
  }
}

std::vector<double> combined(Kind kind, const std::vector<double>& a,
                             const std::vector<double>& b) {
  const std::size_t size = std::max(a.size(), b.size());
  if ((a.size() != 1 && a.size() != size) || (b.size() != 1 && b.size() != size)) {
    throw files::failed("", "cannot combine " + std::to_string(a.size()) + " numbers with " +
                                std::to_string(b.size()) + " cell by cell");
  }
  std::vector<double> values;
  for (std::size_t k = 0; k < size; ++k) {
    values.push_back(combined(kind, a[a.size() == 1 ? 0 : k], b[b.size() == 1 ? 0 : k]));
  }
  return values;
}

}  // namespace

Evaluation::Evaluation(Tables tables, bool steady_only) : tables_(std::move(tables)) {
  for (const auto& [name, table] : tables_) {
    auto& rows = all_.emplace_back();
    for (std::size_t row = 0; row < table->rows(); ++row) {
      if (!steady_only || steady(*table, row)) rows.push_back(row);
    }
  }
}

std::vector<std::size_t> Evaluation::tables_with(const std::string& column) const {
  std::vector<std::size_t> found;
  for (std::size_t t = 0; t < tables_.size(); ++t) {
    const auto& [name, table] = tables_[t];
    const bool prefixed = column.starts_with(name + ".");
    if (table->has_column(prefixed ? column.substr(name.size() + 1) : column)) found.push_back(t);
  }
  if (!found.empty()) return found;
  std::vector<std::string> known;
  for (const auto& one : tables_.front().second->columns()) known.push_back(one.name);
  const auto nearest = files::nearest_word(column, known);
  throw files::bad_input("", "no table of this claim has a column '" + column + "'" +
                                 (nearest ? "; did you mean '" + *nearest + "'?" : ""));
}

std::size_t Evaluation::column_in(std::size_t t, const std::string& name) const {
  const auto& [alias, table] = tables_[t];
  return table->column(name.starts_with(alias + ".") ? name.substr(alias.size() + 1) : name);
}

Evaluation::Place Evaluation::place_of(const std::string& name) const {
  const std::size_t t = tables_with(name).front();
  return {t, column_in(t, name)};
}

const Evaluation::Cell& Evaluation::cell(Place place, std::size_t row) {
  const std::uint64_t key =
      (std::uint64_t(place.table) << 56) | (std::uint64_t(place.column) << 40) | std::uint64_t(row);
  const auto [found, fresh] = cell_index_.try_emplace(key, cells_.size());
  if (!fresh) return cells_[found->second];
  const CsvTable& table = *tables_[place.table].second;
  const double mean = table.number(row, place.column);
  const std::string& name = table.columns()[place.column].name;
  const std::string error_name = name == "value" ? "standard_error" : name + "_se";
  double error = 0;
  if (table.has_column(error_name)) error = table.number(row, table.column(error_name));
  cells_.push_back({mean, std::isfinite(error) ? error : 0, mean});
  return cells_.back();
}

void Evaluation::redraw(const std::function<double()>& normal) {
  for (auto& cell : cells_) {
    cell.drawn = cell.error > 0 ? cell.mean + cell.error * normal() : cell.mean;
  }
}

Evaluation::Values Evaluation::column(const std::string& name, const Rows& rows) {
  const Place place = place_of(name);
  Values values;
  for (const std::size_t row : rows[place.table]) {
    const double value = cell(place, row).drawn;
    if (!std::isnan(value)) values.push_back(value);
  }
  if (values.empty()) throw files::failed("", "no row has a number in '" + name + "'");
  if (values.size() != rows[place.table].size()) {
    throw files::failed("", "'" + name + "' is empty in " +
                                std::to_string(rows[place.table].size() - values.size()) +
                                " of the rows looked at");
  }
  return values;
}

const Evaluation::Rows& Evaluation::narrowed(const Formula& formula, const Rows& rows) {
  const auto [found, fresh] = narrowed_.try_emplace({&formula, rows});
  Rows& result = found->second;
  if (!fresh) return result;
  result = rows;
  for (const auto& condition : formula.conditions) {
    for (const std::size_t t : tables_with(condition.column)) {
      const CsvTable& table = *tables_[t].second;
      const std::size_t column = column_in(t, condition.column);
      std::erase_if(result[t],
                    [&](std::size_t row) { return !meets(table.text(row, column), condition); });
    }
  }
  return result;
}

Evaluation::Values Evaluation::each(const Formula& formula, const Rows& rows) {
  const auto [found, fresh] = groups_.try_emplace({&formula, rows});
  if (fresh) {
    const Place place = place_of(formula.word);
    std::vector<std::string> seen;
    for (const std::size_t row : rows[place.table]) {
      const auto& text = tables_[place.table].second->text(row, place.column);
      if (std::ranges::find(seen, text) == seen.end()) seen.push_back(text);
    }
    for (const auto& text : seen) {
      Rows group = rows;
      for (const std::size_t t : tables_with(formula.word)) {
        const auto& table = *tables_[t].second;
        const std::size_t column = column_in(t, formula.word);
        std::erase_if(group[t], [&](std::size_t row) {
          return !meets(table.text(row, column), {formula.word, "=", text});
        });
      }
      found->second.push_back(std::move(group));
    }
  }
  Values values;
  std::string problem = "no row has a " + formula.word;
  auto& kept = found->second;
  for (std::size_t k = 0; k < kept.size();) {
    try {
      values.push_back(one_number(formula.parts.front(), kept[k]));
      ++k;
    } catch (const files::Error& error) {
      if (error.kind() != files::Error::Kind::failed) throw;
      problem = error.faults().front().what;
      left_out_.push_back("a value of " + formula.word + " is left out: " + problem);
      kept.erase(kept.begin() + std::ptrdiff_t(k));
    }
  }
  if (values.empty()) throw files::failed("", problem);
  return values;
}

Evaluation::Values Evaluation::values(const Formula& formula, const Rows& rows) {
  switch (formula.kind) {
    case Kind::number:
      return {formula.number};
    case Kind::column:
      return column(formula.word, rows);
    case Kind::each:
      return each(formula, rows);
    case Kind::rows:
      try {
        return values(formula.parts.front(), narrowed(formula, rows));
      } catch (const files::Error& error) {
        throw files::Error(error.kind(), "",
                           error.faults().front().what + " [" + text_of(formula.conditions) + "]");
      }
    case Kind::negative: {
      return combined(Kind::difference, {0}, values(formula.parts.front(), rows));
    }
    case Kind::call:
      break;
    default:
      return combined(formula.kind, values(formula.parts[0], rows), values(formula.parts[1], rows));
  }
  const auto function = std::ranges::find(functions(), formula.word, &Function::name);
  if (function == functions().end() || function->arguments != formula.parts.size()) {
    throw files::bad_input("", "there is no function " + formula.word + " of " +
                                   std::to_string(formula.parts.size()) + " arguments");
  }
  std::vector<Values> arguments;
  for (const auto& part : formula.parts) arguments.push_back(values(part, rows));
  return {function->value(arguments)};
}

double Evaluation::one_number(const Formula& formula, const Rows& rows) {
  const Values found = values(formula, rows);
  if (found.size() == 1) return found.front();
  throw files::failed("", "the formula gives " + std::to_string(found.size()) +
                              " numbers where one is needed: take a mean, the largest, ...");
}

double Evaluation::number(const Formula& formula) { return one_number(formula, all_); }

}  // namespace shakebed::fitting::claims
