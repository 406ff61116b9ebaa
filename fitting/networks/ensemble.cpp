#include "fitting/networks/ensemble.hpp"

#include <algorithm>
#include <cmath>

namespace shakebed::fitting::networks {
namespace {

using files::CsvColumn;
using files::CsvTable;
using files::number_text;
using Replicas = std::vector<std::vector<NamedNumber>>;

/// Over the replicas for which the number exists.
Spread spread_of(const Replicas& replicas, std::size_t number) {
  std::vector<double> values;
  for (const auto& one : replicas) {
    if (!std::isnan(one[number].value)) values.push_back(one[number].value);
  }
  return spread(values);
}

/// Mean, standard deviation and standard error as cells; empty where there are none.
void push(std::vector<std::string>& cells, const Spread& spread) {
  const bool any = spread.replicas > 0;
  cells.push_back(any ? number_text(spread.mean) : "");
  cells.push_back(any ? number_text(spread.standard_deviation) : "");
  cells.push_back(
      any ? number_text(spread.standard_deviation / std::sqrt(static_cast<double>(spread.replicas)))
          : "");
}

std::vector<CsvColumn> with(std::vector<CsvColumn> columns, std::vector<CsvColumn> more) {
  columns.insert(columns.end(), more.begin(), more.end());
  return columns;
}

/// What a paper says of a quantity at a place of the sweep.
class Reference {
 public:
  Reference(const CsvTable& table, const std::vector<CsvColumn>& columns)
      : table_(table), columns_(columns) {}

  struct Entry {
    std::string paper;
    std::string source;
  };
  Entry find(const Ensemble::Labels& place, const std::string& quantity) const {
    for (std::size_t row = 0; row < table_.rows(); ++row) {
      if (table_.text(row, table_.column("quantity")) == quantity && at(place, row)) {
        return {table_.text(row, table_.column("paper")),
                table_.text(row, table_.column("source"))};
      }
    }
    return {};
  }

 private:
  bool at(const Ensemble::Labels& place, std::size_t row) const {
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      if (!table_.has_column(columns_[c].name)) continue;
      if (table_.text(row, table_.column(columns_[c].name)) != place[c]) return false;
    }
    return true;
  }

  const CsvTable& table_;
  const std::vector<CsvColumn>& columns_;
};

void add_cycle_row(CsvTable& table, const Ensemble::Labels& place, double instant,
                   const Replicas& replicas) {
  auto cells = place;
  cells.push_back(number_text(instant));
  cells.push_back(std::to_string(replicas.size()));
  for (std::size_t k = 0; k < replicas.front().size(); ++k) push(cells, spread_of(replicas, k));
  table.add_row(std::move(cells));
}

void add_number_rows(CsvTable& table, const Ensemble::Labels& place, double instant,
                     const Replicas& replicas, const Reference& reference) {
  for (std::size_t k = 0; k < replicas.front().size(); ++k) {
    const NamedNumber& number = replicas.front()[k];
    const Spread found = spread_of(replicas, k);
    const auto entry = reference.find(place, number.name);
    auto cells = place;
    cells.insert(cells.end(), {number_text(instant), number.name, number.unit});
    push(cells, found);
    cells.insert(cells.end(), {std::to_string(found.replicas), entry.paper, entry.source});
    table.add_row(std::move(cells));
  }
}

void add_pass_rows(CsvTable& table, const Ensemble::Labels& place, const Replicas& replicas,
                   const Reference& reference) {
  const auto& names = replicas.front();
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (!names[k].name.starts_with("NP_")) continue;
    const std::string pass = names[k].name.substr(3);
    auto cells = place;
    cells.push_back(pass);
    for (std::size_t counted = k; counted < k + 5; ++counted) {
      push(cells, spread_of(replicas, counted));
    }
    for (const char* counted : {"NP_", "NE_", "NT_", "NE_rest_"}) {
      cells.push_back(reference.find(place, counted + pass).paper);
    }
    table.add_row(std::move(cells));
  }
}

void add_edge_rows(CsvTable& table, const Ensemble::Labels& place, const Member& member) {
  const auto& networks = member.analysis.networks;
  for (const Index k : networks.contacts) {
    const Contact& contact = member.snapshot.contacts[k];
    if (contact.normal_force <= networks.mean_force) continue;
    auto cells = place;
    for (const Index grain : {contact.i, contact.j}) {
      for (const double x : member.snapshot.position[grain]) cells.push_back(number_text(x));
    }
    cells.push_back(number_text(contact.normal_force));
    cells.push_back(number_text(contact.normal_force / networks.mean_force));
    table.add_row(std::move(cells));
  }
}

void add_grain_rows(CsvTable& table, const Ensemble::Labels& place, const Snapshot& snapshot) {
  for (std::size_t i = 0; i < snapshot.grains(); ++i) {
    auto cells = place;
    for (const double x : snapshot.position[i]) cells.push_back(number_text(x));
    cells.push_back(number_text(snapshot.radius[i]));
    table.add_row(std::move(cells));
  }
}

std::vector<CsvColumn> mean_and_spread(const std::string& name, const std::string& unit) {
  return {{name, unit}, {name + "_sd", unit}, {name + "_se", unit}};
}

}  // namespace

void Ensemble::add(const Labels& place, double instant, Member member) {
  if (std::find(places_.begin(), places_.end(), place) == places_.end()) places_.push_back(place);
  numbers_[place][instant].push_back(numbers_of(member.analysis));
  auto& first = first_.try_emplace(place, First{instant, {}}).first->second;
  if (instant < first.instant) first = {instant, {}};
  if (instant == first.instant) first.members.push_back(std::move(member));
}

std::vector<NamedTable> Ensemble::tables(const CsvTable& reference) const {
  std::vector<CsvColumn> cycle = with(columns_, {{"T", "cycles"}, {"replicas", "1"}});
  if (!places_.empty()) {
    for (const auto& number : numbers_.at(places_.front()).begin()->second.front()) {
      cycle = with(cycle, mean_and_spread(number.name, number.unit));
    }
  }
  std::vector<CsvColumn> passes = with(columns_, {{"passes", ""}});
  for (const char* name : {"NP", "NE", "NT", "NE_rest", "missing"}) {
    passes = with(passes, mean_and_spread(name, "1"));
  }
  passes = with(passes,
                {{"NP_paper", "1"}, {"NE_paper", "1"}, {"NT_paper", "1"}, {"NE_rest_paper", "1"}});
  const std::vector<CsvColumn> ends{{"x_i", "d"},
                                    {"y_i", "d"},
                                    {"z_i", "d"},
                                    {"x_j", "d"},
                                    {"y_j", "d"},
                                    {"z_j", "d"},
                                    {"normal_force", "m g"},
                                    {"f", "mean force"}};
  std::vector<NamedTable> all{
      {"cycle", CsvTable(cycle)},
      {"numbers", CsvTable(with(columns_, {{"T", "cycles"},
                                           {"quantity", ""},
                                           {"unit", ""},
                                           {"mean", ""},
                                           {"sd", ""},
                                           {"mean_se", ""},
                                           {"replicas", "1"},
                                           {"paper", ""},
                                           {"source", ""}}))},
      {"passes", CsvTable(passes)},
      {"pdf", CsvTable(with(columns_, pdf_columns()))},
      {"fits", CsvTable(with(columns_, fit_columns()))},
      {"correlation", CsvTable(with(columns_, correlation_columns()))},
      {"edges", CsvTable(with(columns_, ends))},
      {"grains", CsvTable(with(columns_, {{"x", "d"}, {"y", "d"}, {"z", "d"}, {"radius", "d"}}))}};
  const Reference paper(reference, columns_);
  for (const Labels& place : places_) {
    const auto& instants = numbers_.at(place);
    const auto& first = first_.at(place);
    for (const auto& [instant, replicas] : instants) {
      add_cycle_row(all[0].table, place, instant, replicas);
    }
    add_number_rows(all[1].table, place, first.instant, instants.begin()->second, paper);
    add_pass_rows(all[2].table, place, instants.begin()->second, paper);
    add_pdf_rows(all[3].table, place, first.members);
    add_fit_rows(all[4].table, place, first.members);
    add_correlation_rows(all[5].table, place, first.members);
    add_edge_rows(all[6].table, place, first.members.front());
    add_grain_rows(all[7].table, place, first.members.front().snapshot);
  }
  return all;
}

}  // namespace shakebed::fitting::networks
