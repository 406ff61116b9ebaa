#include "fitting/claims/claim.hpp"

#include <gsl/gsl_randist.h>

#include <cmath>
#include <limits>

#include "files/error.hpp"
#include "fitting/claims/evaluate.hpp"
#include "fitting/gsl.hpp"

namespace shakebed::fitting::claims {
namespace {

using files::number_text;
using files::YamlNode;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr int draws = 400;
constexpr unsigned long seed = 3;

void read_bounds(const YamlNode& node, Claim& claim) {
  node.refuse_unknown_keys({"above", "below", "from", "to"});
  claim.from = -infinity;
  claim.to = infinity;
  for (const char* key : {"above", "from"}) {
    if (const auto bound = node.find(key)) claim.from = bound->as_double();
  }
  for (const char* key : {"below", "to"}) {
    if (const auto bound = node.find(key)) claim.to = bound->as_double();
  }
  const bool both =
      (node.has("above") && node.has("from")) || (node.has("below") && node.has("to"));
  if (both || node.items().empty() || !(claim.from < claim.to)) {
    throw node.error("expected {above: x}, {below: x} or {from: x, to: y} with x < y");
  }
}

double spread_of_draws(Evaluation& evaluation, const Formula& formula) {
  const auto random = gsl::owned<gsl::RandomStream>(gsl_rng_alloc(gsl_rng_mt19937));
  gsl_rng_set(random.get(), seed);
  double sum = 0;
  double squares = 0;
  double first = 0;
  for (int draw = 0; draw < draws; ++draw) {
    evaluation.redraw([&] { return gsl_ran_gaussian(random.get(), 1); });
    const double value = evaluation.number(formula);
    if (draw == 0) first = value;
    sum += value - first;
    squares += (value - first) * (value - first);
  }
  return std::sqrt(std::max(0.0, (squares - sum * sum / draws) / (draws - 1)));
}

Result missing(const std::string& remark) {
  return {unknown, unknown, Verdict::not_decided, remark};
}

}  // namespace

std::string Claim::bounds_text() const {
  if (from == -infinity) return "< " + number_text(to);
  if (to == infinity) return "> " + number_text(from);
  return number_text(from) + " to " + number_text(to);
}

std::string text_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds:
      return "holds";
    case Verdict::differs:
      return "differs";
    case Verdict::not_decided:
      break;
  }
  return "not decided";
}

Claim read_claim(const YamlNode& node) {
  node.refuse_unknown_keys(
      {"id", "says", "source", "unit", "table", "tables", "rows", "compute", "holds", "why"});
  Claim claim;
  claim.where = node.where();
  claim.id = node.at("id").as_string();
  claim.says = node.at("says").as_string();
  claim.source = node.at("source").as_string();
  claim.unit = node.at("unit").as_string();
  claim.why = node.at("why").as_string();
  if (const auto table = node.find("table")) claim.tables.emplace_back("table", table->as_string());
  if (const auto tables = node.find("tables")) {
    for (const auto& [name, table] : tables->items()) {
      claim.tables.emplace_back(name, table.as_string());
    }
  }
  if (claim.tables.empty()) throw node.error("a claim needs `table` or `tables`");
  if (const auto rows = node.find("rows")) {
    const std::string word = rows->as_string();
    if (word != "all" && word != "steady") throw rows->error("expected all or steady, got " + word);
    claim.steady_only = word == "steady";
  }
  const YamlNode formula = node.at("compute");
  claim.formula_text = formula.as_string();
  claim.formula = read_formula(claim.formula_text, formula.where());
  read_bounds(node.at("holds"), claim);
  return claim;
}

Result judge(const Claim& claim, const TableSource& tables) {
  Evaluation::Tables found;
  for (const auto& [name, id] : claim.tables) {
    const auto* table = tables(id);
    if (table == nullptr) return missing("the table " + id + " is not there");
    found.emplace_back(name, table);
  }
  Evaluation evaluation(found, claim.steady_only);
  Result result{};
  try {
    result.value = evaluation.number(claim.formula);
    result.standard_error = spread_of_draws(evaluation, claim.formula);
  } catch (const files::Error& error) {
    if (error.kind() == files::Error::Kind::failed) return missing(error.faults().front().what);
    throw files::bad_input(claim.where, claim.id + ": " + error.faults().front().what);
  }
  if (!std::isfinite(result.value) || !std::isfinite(result.standard_error)) {
    return missing("the formula gives no finite number");
  }
  const double low = result.value - 1.96 * result.standard_error;
  const double high = result.value + 1.96 * result.standard_error;
  result.verdict = Verdict::not_decided;
  if (low >= claim.from && high <= claim.to) result.verdict = Verdict::holds;
  if (high < claim.from || low > claim.to) result.verdict = Verdict::differs;
  if (result.verdict == Verdict::not_decided) result.remark = "the error reaches over a bound";
  for (const auto& text : evaluation.left_out()) {
    result.remark += (result.remark.empty() ? "" : "; ") + text;
  }
  return result;
}

}  // namespace shakebed::fitting::claims
