#include "fitting/fit_file.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "files/yaml.hpp"
#include "fitting/fit_file_parts.hpp"

namespace shakebed::fitting {
namespace {

using files::YamlNode;

const std::vector<std::string> shared_keys = {
    "id",      "select",  "for_each",           "y",   "y_error",
    "exclude", "peak_of", "minimum_stationary", "W_2", "if_impossible"};
const std::vector<std::string> fit_keys = {"x",          "model", "method",    "weights",
                                           "covariance", "range", "reference", "compare_at"};
const std::vector<std::string> peak_keys = {"depth"};

std::vector<std::string> together(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// One entry of `fits` or `peaks`, with the file's `defaults` behind it.
class Entry {
 public:
  Entry(YamlNode own, std::optional<YamlNode> defaults)
      : own_(std::move(own)), defaults_(std::move(defaults)) {}

  const YamlNode& node() const { return own_; }
  std::optional<YamlNode> find(std::string_view key) const {
    if (auto found = own_.find(key)) return found;
    return defaults_ ? defaults_->find(key) : std::nullopt;
  }
  YamlNode at(std::string_view key) const {
    if (auto found = find(key)) return *found;
    return own_.at(key);  // throws with the place of this entry
  }

 private:
  YamlNode own_;
  std::optional<YamlNode> defaults_;
};

void read_shared(const Entry& entry, DataSpecification& data) {
  data.id = entry.node().at("id").as_string();
  data.where = entry.node().where();
  if (const auto select = entry.find("select")) data.rows.select = read_select(*select);
  if (const auto columns = entry.find("for_each")) {
    for (const auto& column : one_or_more(*columns)) data.for_each.push_back(column.as_string());
  }
  if (const auto list = entry.find("exclude")) {
    for (const auto& one : list->elements()) data.rows.exclude.push_back(read_exclusion(one));
  }
  if (const auto least = entry.find("minimum_stationary")) {
    // 0 takes every row: where what is not stationary is what is measured.
    data.rows.minimum_stationary = least->as_string() == "0" ? 0 : share(*least);
  }
  data.y = entry.at("y").as_string();
  data.y_error = data.y + "_se";
  if (const auto error = entry.find("y_error")) {
    data.y_error = error->as_string() == "none" ? "" : error->as_string();
  }
  const auto peak_of = entry.find("peak_of");
  data.peak_of = peak_of ? peak_of->as_string() : "T_z_scaled";
  data.report_problems = !data.for_each.empty();
  if (const auto word = entry.find("if_impossible")) {
    const bool report = word_of<bool>(*word, {{"report", true}, {"refuse", false}});
    data.report_problems = data.report_problems || report;
  }
  if (const auto rule = entry.find("W_2")) {
    rule->refuse_unknown_keys({"within", "tail"});
    if (const auto within = rule->find("within")) data.settling.within = share(*within);
    if (const auto tail = rule->find("tail")) data.settling.tail = share(*tail);
  }
}

FitSpecification read_fit(const Entry& entry, const files::CsvTable* studies) {
  entry.node().refuse_unknown_keys(together(shared_keys, fit_keys));
  FitSpecification fit;
  read_shared(entry, fit);
  fit.x = entry.at("x").as_string();
  fit.model = read_model(entry.at("model"));
  fit.methods = {fit.model.name == "power_law" ? Method::log_log : Method::linear};
  if (const auto methods = entry.find("method")) {
    fit.methods.clear();
    for (const auto& method : one_or_more(*methods)) {
      fit.methods.push_back(
          word_of<Method>(method, {{"linear", Method::linear}, {"log_log", Method::log_log}}));
      if (fit.methods.back() == Method::log_log && fit.model.name != "power_law") {
        throw method.error("log_log fits a power_law, not " + fit.model.name);
      }
    }
  }
  fit.weights = {fit.y_error.empty() ? Weights::equal : Weights::errors};
  if (const auto weights = entry.find("weights")) {
    fit.weights.clear();
    for (const auto& word : one_or_more(*weights)) {
      fit.weights.push_back(
          word_of<Weights>(word, {{"errors", Weights::errors}, {"equal", Weights::equal}}));
      if (fit.weights.back() == Weights::errors && fit.y_error.empty()) {
        throw word.error("`weights: errors` needs a y_error column");
      }
    }
  }
  if (const auto covariance = entry.find("covariance")) {
    fit.scale =
        word_of<Scale>(*covariance, {{"scaled", Scale::estimated}, {"given", Scale::given}});
    if (fit.scale == Scale::given && std::ranges::count(fit.weights, Weights::equal) > 0) {
      throw covariance->error("`covariance: given` needs `weights: errors`");
    }
  }
  if (const auto range = entry.find("range")) fit.range = read_range(*range, studies);
  if (const auto reference = entry.find("reference")) {
    fit.reference = read_reference(*reference, fit.model);
  }
  if (const auto places = entry.find("compare_at")) {
    for (const auto& place : places->elements()) fit.compare_at.push_back(place.as_double());
  }
  return fit;
}

PeakSpecification read_peak(const Entry& entry) {
  entry.node().refuse_unknown_keys(together(shared_keys, peak_keys));
  PeakSpecification peak;
  read_shared(entry, peak);
  if (const auto depth = entry.node().find("depth")) peak.rule.depth = share(*depth);
  return peak;
}

RatioSpecification read_ratio(const YamlNode& node) {
  node.refuse_unknown_keys({"id", "of", "over", "against", "match"});
  RatioSpecification ratio;
  ratio.where = node.where();
  ratio.id = node.at("id").as_string();
  ratio.of = node.at("of").as_string();
  ratio.over = ratio.of;
  if (const auto over = node.find("over")) ratio.over = over->as_string();
  if (const auto against = node.find("against")) {
    ratio.against = read_select(*against);
    for (const auto& column : one_or_more(node.at("match"))) {
      ratio.match.push_back(column.as_string());
    }
  } else if (ratio.over == ratio.of) {
    throw node.error("a column over itself is 1: expected `over`, or `against` with `match`");
  }
  return ratio;
}

FitFile read(const YamlNode& root, const std::filesystem::path& file) {
  root.refuse_unknown_keys({"fit", "id", "data", "studies", "defaults", "fits", "peaks", "ratios"});
  const YamlNode schema = root.at("fit");
  if (schema.as_integer() != 1) {
    throw schema.error("this program reads fit schema 1, got " + schema.as_string());
  }
  FitFile result;
  result.id = root.at("id").as_string();
  if (const auto data = root.find("data")) result.data = file.parent_path() / data->as_string();
  std::optional<files::CsvTable> studies;
  if (const auto table = root.find("studies")) {
    studies = files::CsvTable::read(file.parent_path() / table->as_string());
  }
  const auto defaults = root.find("defaults");
  if (defaults) {
    defaults->refuse_unknown_keys(together(together(shared_keys, fit_keys), peak_keys));
    if (const auto id = defaults->find("id")) throw id->error("every entry needs an id of its own");
  }
  std::set<std::string> ids;
  const auto unique = [&](const DataSpecification& entry) {
    if (!ids.insert(entry.id).second) {
      throw files::bad_input(entry.where, "the id " + entry.id + " is used twice in this file");
    }
  };
  if (const auto fits = root.find("fits")) {
    for (const auto& node : fits->elements()) {
      result.fits.push_back(read_fit(Entry(node, defaults), studies ? &*studies : nullptr));
      unique(result.fits.back());
    }
  }
  if (const auto peaks = root.find("peaks")) {
    for (const auto& node : peaks->elements()) {
      result.peaks.push_back(read_peak(Entry(node, defaults)));
      unique(result.peaks.back());
    }
  }
  if (const auto ratios = root.find("ratios")) {
    for (const auto& node : ratios->elements()) result.ratios.push_back(read_ratio(node));
  }
  if (result.fits.empty() && result.peaks.empty() && result.ratios.empty()) {
    throw root.error("nothing to do: expected `fits`, `peaks` or `ratios` with at least one entry");
  }
  return result;
}

}  // namespace

FitFile read_fit_file(const std::filesystem::path& file) {
  return read(YamlNode::load_file(file), file);
}

FitFile read_fit_text(std::string_view text, const std::filesystem::path& file) {
  return read(YamlNode::load_text(text, file.string()), file);
}

}  // namespace shakebed::fitting
