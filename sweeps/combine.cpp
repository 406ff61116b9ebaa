#include "sweeps/combine.hpp"

#include <algorithm>
#include <array>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <cstdio>
#include <set>
#include <string_view>

namespace shakebed::sweeps {
namespace {

using simulator::Record;

constexpr std::array<const char*, 2> tested_for_scatter{"T_z", "h_cm"};

constexpr std::array<std::string_view, 7> counts{
    "collisions",      "contact_steps", "contacts_closed", "contacts_fine",
    "contacts_undone", "breaches",      "dense_steps"};

const simulator::Quantity* quantity_of(const Record& record, const std::string& name) {
  for (const auto& quantity : record.quantities) {
    if (quantity.name == name) return &quantity;
  }
  return nullptr;
}

double scalar_of(const Record& record, const std::string& name, double otherwise) {
  for (const auto& scalar : record.scalars) {
    if (scalar.name == name) return scalar.value;
  }
  return otherwise;
}

std::vector<Contribution> contributions(const std::vector<Record>& replicates,
                                        const std::string& name) {
  std::vector<Contribution> found;
  for (const auto& record : replicates) {
    const auto* quantity = quantity_of(record, name);
    if (quantity != nullptr) found.push_back({quantity->estimate, scalar_of(record, "cycles", 1)});
  }
  return found;
}

double combined_scalar(const std::vector<Record>& replicates, const std::string& name) {
  std::vector<double> values;
  for (const auto& record : replicates) values.push_back(scalar_of(record, name, std::nan("")));
  if (std::find(counts.begin(), counts.end(), name) != counts.end()) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum;
  }
  if (name == "largest_overlap") return *std::max_element(values.begin(), values.end());
  // Equal values stay exactly what they are.
  if (std::all_of(values.begin(), values.end(), [&](double v) { return v == values[0]; })) {
    return values[0];
  }
  double mean = 0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  return mean;
}

/// Texts once each, in order of appearance.
class Reasons {
 public:
  void add(const std::string& text) {
    if (text.empty() || !said_.insert(text).second) return;
    joined_ += (joined_.empty() ? "" : "; ") + text;
  }
  const std::string& text() const { return joined_; }

 private:
  std::set<std::string> said_;
  std::string joined_;
};

void say_scatter(const std::vector<Record>& replicates, Reasons& reasons) {
  for (const char* name : tested_for_scatter) {
    const Combined combined = combine(contributions(replicates, name));
    if (combined.degrees_of_freedom < 1) continue;
    if (chance_of_scatter(combined) >= false_alarm_rate / tested_for_scatter.size()) continue;
    char text[96];
    std::snprintf(text, sizeof text, "replicates disagree on %s (chi^2 = %.3g, %d dof)", name,
                  combined.chi_squared, combined.degrees_of_freedom);
    reasons.add(text);
  }
}

std::string reason_of(const std::vector<Record>& replicates) {
  Reasons reasons;
  for (const auto& record : replicates) {
    if (record.at_rest) reasons.add("at rest");
    if (!record.stationary) {
      reasons.add("not stationary" +
                  (record.stationary_reason.empty() ? "" : ": " + record.stationary_reason));
    }
    for (const auto& warning : record.warnings) reasons.add(warning);
  }
  say_scatter(replicates, reasons);
  return reasons.text();
}

}  // namespace

Combined combine(const std::vector<Contribution>& replicates) {
  Combined combined;
  if (replicates.empty()) return combined;
  if (replicates.size() == 1) return {replicates.front().estimate, 0, 0};
  double total = 0;
  for (const auto& replicate : replicates) total += replicate.cycles;
  const auto weight = [&](const Contribution& replicate) {
    return total > 0 ? replicate.cycles / total : 1 / static_cast<double>(replicates.size());
  };
  double mean = 0;
  double within = 0;
  for (const auto& replicate : replicates) {
    mean += weight(replicate) * replicate.estimate.mean;
    within += std::pow(weight(replicate) * replicate.estimate.standard_error, 2);
  }
  double between = 0;
  for (const auto& replicate : replicates) {
    between += weight(replicate) * std::pow(replicate.estimate.mean - mean, 2);
  }
  const int freedom = static_cast<int>(replicates.size()) - 1;
  between /= freedom;
  combined.degrees_of_freedom = freedom;
  // Beds at rest have neither errors nor scatter.
  combined.chi_squared = between == 0 ? 0 : freedom * between / within;
  // An error that is not known (NaN) leaves the scatter.
  combined.estimate = {mean, std::sqrt(within > between ? within : between)};
  return combined;
}

double chance_of_scatter(const Combined& combined) {
  if (combined.degrees_of_freedom < 1 || std::isnan(combined.chi_squared)) return 1;
  if (std::isinf(combined.chi_squared)) return 0;
  const boost::math::chi_squared_distribution<double> distribution(combined.degrees_of_freedom);
  return boost::math::cdf(boost::math::complement(distribution, combined.chi_squared));
}

store::TableRow combine_records(const std::vector<Record>& replicates) {
  store::TableRow row;
  if (replicates.empty()) return row;
  const double count = static_cast<double>(replicates.size());
  for (const auto& quantity : replicates.front().quantities) {
    row.quantities.push_back(
        {quantity.name, quantity.unit, combine(contributions(replicates, quantity.name)).estimate});
  }
  for (const auto& scalar : replicates.front().scalars) {
    if (scalar.name == "cycles") continue;
    row.scalars.push_back({scalar.name, scalar.unit, combined_scalar(replicates, scalar.name)});
  }
  for (const auto& record : replicates) {
    row.stationary_fraction += record.stationary;
    row.at_rest_fraction += record.at_rest;
    row.cycles += scalar_of(record, "cycles", 0);
  }
  // Divided once: all of six are 1, and not six sixths of rounding.
  row.stationary_fraction /= count;
  row.at_rest_fraction /= count;
  row.replicates = static_cast<int>(replicates.size());
  row.reason = reason_of(replicates);
  return row;
}

}  // namespace shakebed::sweeps
