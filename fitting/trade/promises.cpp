#include "fitting/trade/promises.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

namespace shakebed::fitting::trade {
namespace {

using files::CsvTable;
using files::number_text;

constexpr double promised = 0.95;

double share_of(const CsvTable& runs, std::size_t row) {
  const auto& text = runs.text(row, runs.column("asked"));
  if (const auto share = files::share_from_percent_text(text)) return *share;
  throw files::bad_input(runs.place(row), "expected a percentage in `asked`, got `" + text + "`");
}

std::size_t reference_row(const CsvTable& references, const std::string& scene) {
  for (std::size_t row = 0; row < references.rows(); ++row) {
    if (references.text(row, references.column("scene")) == scene) return row;
  }
  throw files::bad_input(references.name, "has no reference for `" + scene + "`");
}

void add(Kept& one, double error, double asked, double reference_error) {
  ++one.runs;
  one.kept += std::abs(error) <= asked;
  one.mean_error += error;
  one.largest_error = std::max(one.largest_error, std::abs(error));
  one.reference_error = std::max(one.reference_error, reference_error);
}

void finish(Kept& one) {
  if (one.runs == 0) return;
  one.mean_error /= static_cast<double>(one.runs);
  one.chance = gsl_cdf_binomial_P(static_cast<unsigned>(one.kept), promised,
                                  static_cast<unsigned>(one.runs));
}

}  // namespace

std::vector<Kept> kept_promises(const CsvTable& runs, const CsvTable& references) {
  std::vector<Kept> all;
  Kept total{"all", "all"};
  for (std::size_t row = 0; row < runs.rows(); ++row) {
    const double T_z = runs.number(row, runs.column("T_z"));
    if (std::isnan(T_z)) continue;
    const auto& scene = runs.text(row, runs.column("scene"));
    const auto& asked = runs.text(row, runs.column("asked"));
    const std::size_t truth = reference_row(references, scene);
    const double T_ref = references.number(truth, references.column("T_z"));
    const double T_ref_error = references.number(truth, references.column("T_z_se")) / T_ref;
    auto one = std::ranges::find_if(
        all, [&](const Kept& other) { return other.scene == scene && other.asked == asked; });
    if (one == all.end()) one = all.insert(all.end(), Kept{scene, asked});
    add(*one, T_z / T_ref - 1, share_of(runs, row), T_ref_error);
    add(total, T_z / T_ref - 1, share_of(runs, row), T_ref_error);
  }
  all.push_back(total);
  for (auto& one : all) finish(one);
  return all;
}

CsvTable promises_table(const std::vector<Kept>& kept) {
  CsvTable table({{"scene", ""},
                  {"asked", ""},
                  {"runs", "1"},
                  {"kept", "1"},
                  {"mean_error", "%"},
                  {"largest_error", "%"},
                  {"reference_se", "%"},
                  {"chance", "1"}});
  for (const auto& one : kept) {
    table.add_row({one.scene, one.asked, std::to_string(one.runs), std::to_string(one.kept),
                   number_text(100 * one.mean_error), number_text(100 * one.largest_error),
                   number_text(100 * one.reference_error), number_text(one.chance)});
  }
  return table;
}

}  // namespace shakebed::fitting::trade
