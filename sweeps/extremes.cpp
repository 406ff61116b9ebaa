#include "sweeps/extremes.hpp"

#include <algorithm>
#include <cmath>

#include "files/yaml.hpp"
#include "simulator/record_lookup.hpp"
#include "simulator/scene/read_scene.hpp"
#include "simulator/simulate.hpp"
#include "sweeps/axis.hpp"
#include "sweeps/bias.hpp"
#include "sweeps/store/run_key.hpp"

namespace shakebed::sweeps {
namespace {

using files::number_text;
using files::YamlNode;
using simulator::Record;

constexpr double open_ledger = 0.01;  // of what was dissipated

double percentage(const YamlNode& node) {
  if (const auto share = files::share_from_percent_text(node.as_string())) return *share;
  throw node.error("expected a percentage such as 5 %");
}

ExtremeCase read_case(const YamlNode& node, const std::filesystem::path& folder,
                      const YamlNode& base) {
  ExtremeCase one;
  one.id = node.at("id").as_string();
  one.group = node.at("group").as_string();
  node.refuse_unknown_keys({"group", "id", "set", "scene", "against", "within"});
  if (const auto against = node.find("against")) {
    one.against = against->as_string();
    one.within = percentage(node.at("within"));
  }
  const auto set = node.find("set");
  const auto other = node.find("scene");
  try {
    const auto overrides = set ? read_overrides(*set) : std::vector<simulator::Override>{};
    one.scene = simulator::read_scene(
        other ? YamlNode::load_file(folder / other->as_string()) : base, overrides);
  } catch (const files::Error& error) {
    one.refusal = error.faults().front().what;
  }
  return one;
}

simulator::Estimate estimate_of(const Record& record, const std::string& name) {
  for (const auto& quantity : record.quantities) {
    if (quantity.name == name) return quantity.estimate;
  }
  return {};
}

/// 100 (T_z/T_z,0 - 1) with its standard error.
simulator::Estimate deviation(const Record& record, const Record& reference) {
  return bias_percent(estimate_of(record, "T_z_scaled"), estimate_of(reference, "T_z_scaled"));
}

/// Share of the energy turned over that the ledger cannot account for.
double ledger_gap(const Record& record) {
  const double turned_over =
      std::max({scalar_of(record, "dissipation"), std::abs(scalar_of(record, "base_work")), 1.0});
  return std::abs(scalar_of(record, "ledger_residual")) / turned_over;
}

struct Judgement {
  std::string verdict;
  simulator::Estimate deviation;
};

Judgement judge(const ExtremeCase& one, const Record& record, const Record* reference) {
  Judgement judged;
  // Beyond the margin by more than noise (two standard errors).
  bool off = false;
  if (reference != nullptr) {
    judged.deviation = deviation(record, *reference);
    off = !(std::abs(judged.deviation.mean) - 2 * judged.deviation.standard_error <=
            100 * one.within);
  }
  const bool has_ledger = std::ranges::any_of(
      record.scalars, [](const auto& scalar) { return scalar.name == "ledger_residual"; });
  const bool open = has_ledger && !(ledger_gap(record) <= open_ledger) && !record.at_rest;
  const bool said = !record.warnings.empty() || !record.stationary;
  if (off || open) {
    judged.verdict = said ? "wrong, said" : "wrong, UNSAID";
  } else {
    judged.verdict = record.stationary ? "right" : "no steady state, said";
  }
  return judged;
}

std::string says(const Record& record) {
  std::string text;
  if (!record.stationary) text = record.stationary_reason;
  for (const auto& warning : record.warnings) text += (text.empty() ? "" : "; ") + warning;
  return text.empty() ? "nothing" : text;
}

}  // namespace

ExtremeList read_extremes(const std::filesystem::path& file) {
  const YamlNode root = YamlNode::load_file(file);
  if (root.at("extremes").as_integer() != 1) {
    throw root.at("extremes").error("this program reads lists of schema 1");
  }
  ExtremeList list;
  list.id = root.at("id").as_string();
  const auto folder = file.parent_path();
  const YamlNode base = YamlNode::load_file(folder / root.at("base").as_string());
  for (const auto& node : root.at("cases").elements()) {
    list.cases.push_back(read_case(node, folder, base));
  }
  for (const auto& one : list.cases) {
    if (!one.against) continue;
    const bool known = std::ranges::any_of(
        list.cases, [&](const auto& other) { return other.id == *one.against; });
    if (!known) {
      throw files::bad_input(file.string(),
                             "case `" + one.id + "`: no case is called `" + *one.against + "`");
    }
  }
  return list;
}

std::vector<Run> runs_of(const ExtremeList& list) {
  std::vector<Run> runs;
  for (std::size_t k = 0; k < list.cases.size(); ++k) {
    if (!list.cases[k].scene) continue;
    simulator::Scene scene = *list.cases[k].scene;
    std::string canonical = simulator::canonical_yaml(scene);
    std::string key = store::run_key(canonical, simulator::physics_version, scene.seed);
    runs.push_back({k,
                    0,
                    std::move(scene),
                    {std::move(key), std::move(canonical), simulator::physics_version}});
  }
  return runs;
}

files::CsvTable extremes_table(const ExtremeList& list,
                               const std::vector<std::optional<Record>>& records) {
  files::CsvTable table({{"group", ""},
                         {"case", ""},
                         {"verdict", ""},
                         {"T_z_scaled", "m V_p^2"},
                         {"T_z_scaled_se", "m V_p^2"},
                         {"against", ""},
                         {"deviation", "%"},
                         {"deviation_se", "%"},
                         {"ledger_gap", "%"},
                         {"largest_overlap", "d"},
                         {"says", ""}});
  for (std::size_t k = 0; k < list.cases.size(); ++k) {
    const ExtremeCase& one = list.cases[k];
    if (!one.scene) {
      table.add_row({one.group, one.id, "refused", "", "", "", "", "", "", "", one.refusal});
      continue;
    }
    if (!records[k]) {
      const bool said = !one.failure.empty();
      table.add_row({one.group, one.id, said ? "stopped, said" : "failed", "", "", "", "", "", "",
                     "", said ? one.failure : "did not finish"});
      continue;
    }
    const Record& record = *records[k];
    const Record* reference = nullptr;
    for (std::size_t other = 0; one.against && other < list.cases.size(); ++other) {
      if (list.cases[other].id == *one.against && records[other]) reference = &*records[other];
    }
    const Judgement judged = judge(one, record, reference);
    const auto T_z = estimate_of(record, "T_z_scaled");
    table.add_row({one.group, one.id, judged.verdict, number_text(T_z.mean),
                   number_text(T_z.standard_error), one.against.value_or(""),
                   number_text(judged.deviation.mean), number_text(judged.deviation.standard_error),
                   number_text(100 * ledger_gap(record)),
                   number_text(scalar_of(record, "largest_overlap")), says(record)});
  }
  return table;
}

}  // namespace shakebed::sweeps
