#include "cli/network_json.hpp"

#include <nlohmann/json.hpp>

namespace shakebed::cli {

namespace {

using nlohmann::ordered_json;
namespace networks = fitting::networks;

ordered_json fit_json(const networks::ForceFit& fit, networks::Form form) {
  if (!fit.good()) {
    return {{"a", nullptr},
            {"b", nullptr},
            {"beta", nullptr},
            {"covariance", nullptr},
            {"reason", fit.failure}};
  }
  const std::size_t parameters = form == networks::Form::plain ? 3 : 4;
  ordered_json json{{"a", fit.law.a}, {"b", fit.law.b}, {"beta", fit.law.beta}};
  if (form == networks::Form::shifted) json["theta"] = fit.law.theta;
  for (std::size_t p = 0; p < parameters; ++p) {
    for (std::size_t q = 0; q < parameters; ++q) json["covariance"][p][q] = fit.covariance[p][q];
  }
  const char* names[] = {"a", "b", "beta", "theta"};
  for (std::size_t p = 0; p < parameters; ++p) {
    json["standard_error"][names[p]] = fit.standard_error(p);
  }
  json["chi_squared"] = fit.chi_squared;
  json["degrees_of_freedom"] = fit.degrees_of_freedom;
  json["chi_squared_per_degree"] = fit.chi_squared / fit.degrees_of_freedom;
  json["log_likelihood"] = fit.log_likelihood;
  json["integral"] = fit.law.integral();
  json["mean"] = fit.law.mean();
  json["b_at_bound"] = fit.b_at_bound;
  return json;
}

ordered_json distribution_json(const networks::ForceDistribution& of) {
  using networks::Form;
  return {{"forces", of.forces},
          {"pulling", of.pulling},
          {"bins", of.histogram.bins()},
          {"histogram", fit_json(of.by_histogram, Form::plain)},
          {"likelihood", fit_json(of.by_likelihood, Form::plain)},
          {"shifted",
           {{"histogram", fit_json(of.shifted_by_histogram, Form::shifted)},
            {"likelihood", fit_json(of.shifted_by_likelihood, Form::shifted)}}}};
}

ordered_json published_json(const std::vector<networks::Comparison>& published) {
  ordered_json list = ordered_json::array();
  for (const auto& [source, fit] : published) {
    list.push_back({{"source", source},
                    {"a", fit.law.a},
                    {"b", fit.law.b},
                    {"beta", fit.law.beta},
                    {"integral", fit.law.integral()},
                    {"mean", fit.law.mean()},
                    {"chi_squared", fit.chi_squared},
                    {"chi_squared_per_degree", fit.chi_squared / fit.degrees_of_freedom},
                    {"log_likelihood", fit.log_likelihood}});
  }
  return list;
}

ordered_json largest_json(const networks::Analysis& analysis) {
  const auto& all = analysis.networks.networks;
  const networks::ForceNetwork largest = all.empty() ? networks::ForceNetwork{} : all.front();
  return {{"grains", largest.grains.size()},
          {"contacts", largest.contacts.size()},
          {"coordination", largest.coordination},
          {"strong_grains", largest.strong_grains},
          {"grains_with_strong_contact", largest.grains_with_strong_contact},
          {"strong_contacts", largest.strong_contacts},
          {"extent", largest.extent},
          {"mean_force", largest.mean_force},
          {"pdf", distribution_json(analysis.largest)}};
}

ordered_json pass_json(const networks::PassCounts& row) {
  return {{"passes", row.passes},
          {"NP", row.NP},
          {"NE", row.NE},
          {"NT", row.NT},
          {"NE_rest", row.NE_rest},
          {"missing", row.missing},
          {"tree_length", {{"mean", row.tree.mean}, {"longest", row.tree.longest}}},
          {"captured_length", {{"mean", row.captured.mean}, {"longest", row.captured.longest}}}};
}

ordered_json correlation_json(const networks::Analysis& analysis) {
  const auto& all = analysis.correlation.back();
  ordered_json json{{"bin_width", all.bin_width}, {"length_unit", analysis.median_diameter}};
  json["r"] = ordered_json::array();
  for (std::size_t bin = 0; bin < all.F.size(); ++bin) json["r"].push_back(all.r(bin));
  json["F"] = all.F;
  json["uncorrelated_scatter"] = all.uncorrelated_scatter;
  return json;
}

}  // namespace

ordered_json network_json(const networks::Snapshot& snapshot, const networks::Analysis& analysis,
                          const std::vector<std::string>& warnings) {
  ordered_json json{{"snapshot", snapshot.name},
                    {"grains", snapshot.grains()},
                    {"median_diameter", analysis.median_diameter},
                    {"contacts",
                     {{"with_force", analysis.networks.contacts.size()},
                      {"pulling", analysis.networks.pulling},
                      {"without_force", analysis.networks.without_force},
                      {"with_walls", snapshot.wall_contacts},
                      {"not_touching", snapshot.contacts_not_touching}}},
                    {"networks", analysis.networks.networks.size()},
                    {"largest", largest_json(analysis)},
                    {"mean_force", analysis.networks.mean_force},
                    {"pdf", distribution_json(analysis.all)}};
  json["pdf"]["published"] = published_json(analysis.published);
  json["mst"] = ordered_json::array();
  for (const auto& row : analysis.contacting.passes) json["mst"].push_back(pass_json(row));
  json["elongation"] = analysis.options.elongation;
  json["correlation"] = correlation_json(analysis);
  json["warnings"] = warnings;
  return json;
}

}  // namespace shakebed::cli
