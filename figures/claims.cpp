#include "figures/claims.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "files/csv.hpp"
namespace shakebed::figures {
namespace {

using files::CsvTable;
using files::number_text;
using fitting::claims::Claim;
using fitting::claims::Result;

const std::string shipped = "shipped";

std::string name_of(const JudgedClaim& one) { return one.figure + "/" + one.claim->id; }

std::string rounded(double value) { return files::rounded_text(value, 4); }

std::string number_with_error(const Result& result, const std::string& unit) {
  if (std::isnan(result.value)) return "no number";
  std::string text = rounded(result.value);
  if (result.standard_error > 0) text += " ± " + rounded(result.standard_error);
  return unit == "1" ? text : text + " " + unit;
}

bool shapes_only(const Manifest& manifest, const Entry& entry, const std::string& origin) {
  const auto profiles = manifest.shapes_only.find(entry.paper);
  if (profiles == manifest.shapes_only.end()) return false;
  return std::count(profiles->second.begin(), profiles->second.end(), origin) > 0;
}

/// True when the profile `origin` has computed nothing that the claim needs.
bool nothing_computed(const Claim& claim, const PipelineTables& tables, const std::string& origin) {
  return std::none_of(claim.tables.begin(), claim.tables.end(), [&](const auto& table) {
    return tables.find(origin, table.second) != nullptr;
  });
}

}  // namespace

PipelineTables::PipelineTables(const std::filesystem::path& list) {
  const auto table = CsvTable::read(list);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    files_[{table.text(row, table.column("origin")), table.text(row, table.column("table"))}] =
        list.parent_path() / table.text(row, table.column("file"));
  }
}

const CsvTable* PipelineTables::find(const std::string& origin, const std::string& name) const {
  const auto known = read_.find({origin, name});
  if (known != read_.end()) return &known->second;
  const auto file = files_.find({origin, name});
  if (file == files_.end() || !std::filesystem::exists(file->second)) return nullptr;
  return &(read_[{origin, name}] = CsvTable::read(file->second));
}

bool PipelineTables::any(const std::string& origin) const {
  for (const auto& [name, file] : files_) {
    if (name.first == origin && std::filesystem::exists(file)) return true;
  }
  return false;
}

std::vector<JudgedClaim> judge_claims(const Manifest& manifest, const PipelineTables& tables,
                                      const std::vector<std::string>& origins) {
  std::vector<JudgedClaim> judged;
  for (const auto& entry : manifest.entries) {
    for (const auto& claim : entry.claims) {
      JudgedClaim one{entry.id, &claim, {}};
      for (const auto& origin : origins) {
        if (origin != shipped && nothing_computed(claim, tables, origin)) continue;
        Result& result = one.results[origin] = fitting::claims::judge(
            claim, [&](const std::string& name) { return tables.find(origin, name); });
        if (std::isnan(result.value) || !shapes_only(manifest, entry, origin)) continue;
        result.verdict = fitting::claims::Verdict::not_decided;
        result.remark = "beds of this profile show shapes only";
      }
      judged.push_back(std::move(one));
    }
  }
  return judged;
}

CsvTable recorded_verdicts(const std::vector<JudgedClaim>& judged) {
  CsvTable table({{"figure", ""},
                  {"claim", ""},
                  {"value", ""},
                  {"standard_error", ""},
                  {"unit", ""},
                  {"verdict", ""}});
  for (const auto& one : judged) {
    const auto& result = one.results.at(shipped);
    table.add_row({one.figure, one.claim->id, number_text(result.value),
                   number_text(result.standard_error), one.claim->unit,
                   fitting::claims::text_of(result.verdict)});
  }
  return table;
}

std::vector<std::string> changes_since(const CsvTable& recorded,
                                       const std::vector<JudgedClaim>& judged) {
  std::map<std::string, std::string> before;
  for (std::size_t row = 0; row < recorded.rows(); ++row) {
    before[recorded.text(row, recorded.column("figure")) + "/" +
           recorded.text(row, recorded.column("claim"))] =
        recorded.text(row, recorded.column("verdict"));
  }
  std::vector<std::string> changes;
  for (const auto& one : judged) {
    const auto now = fitting::claims::text_of(one.results.at(shipped).verdict);
    const auto found = before.find(name_of(one));
    if (found == before.end()) {
      changes.push_back(name_of(one) + ": not recorded, now " + now);
      continue;
    }
    if (found->second != now) {
      changes.push_back(name_of(one) + ": recorded " + found->second + ", now " + now);
    }
    before.erase(found);
  }
  for (const auto& [name, verdict] : before) {
    changes.push_back(name + ": recorded " + verdict + ", no longer in the manifest");
  }
  return changes;
}

CsvTable claims_table(const std::vector<JudgedClaim>& judged) {
  CsvTable table({{"figure", ""},
                  {"claim", ""},
                  {"says", ""},
                  {"source", ""},
                  {"holds_if", ""},
                  {"unit", ""},
                  {"origin", ""},
                  {"value", ""},
                  {"standard_error", ""},
                  {"verdict", ""},
                  {"remark", ""}});
  for (const auto& one : judged) {
    const Claim& claim = *one.claim;
    for (const auto& [origin, result] : one.results) {
      table.add_row({one.figure, claim.id, claim.says, claim.source, claim.bounds_text(),
                     claim.unit, origin, number_text(result.value),
                     number_text(result.standard_error), fitting::claims::text_of(result.verdict),
                     result.remark});
    }
  }
  return table;
}

std::string claims_text(const std::vector<JudgedClaim>& judged) {
  std::string text;
  std::string figure;
  std::map<std::string, int> counts;
  for (const auto& one : judged) {
    if (one.figure != figure) text += (figure.empty() ? "" : "\n") + one.figure + "\n";
    figure = one.figure;
    const Claim& claim = *one.claim;
    text += "  " + claim.id + " (" + claim.source + "): " + claim.says + "\n";
    for (const auto& [origin, result] : one.results) {
      const auto verdict = fitting::claims::text_of(result.verdict);
      if (origin == shipped) ++counts[verdict];
      text += "    " + origin + ": " + number_with_error(result, claim.unit) + ", holds if " +
              claim.bounds_text() + ": " + verdict +
              (result.remark.empty() ? "" : " (" + result.remark + ")") + "\n";
    }
  }
  text += "\nfrom the shipped averages:";
  for (const auto& [verdict, count] : counts) text += " " + std::to_string(count) + " " + verdict;
  return text + "\n";
}

}  // namespace shakebed::figures
