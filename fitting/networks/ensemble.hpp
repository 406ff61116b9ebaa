#pragma once

#include <map>
#include <string>
#include <vector>

#include "files/csv.hpp"
#include "fitting/networks/analysis.hpp"
#include "fitting/networks/tables.hpp"

namespace shakebed::fitting::networks {

/// One number of an analysis.
struct NamedNumber {
  std::string name;  ///< "largest_contacts", "NE_2" (after pass 2), "beta_likelihood", ...
  std::string unit;
  double value;  ///< NaN where it does not exist (no network, no fit)
};

/// The numbers of Sec. III B and C of Sun 2006 for one snapshot: its networks, the largest one, the
/// rows of Table II, the fits of P(f) over all contacts by both methods and the shifts theta of the
/// trees' (Eq. 13), what passes capture against all contacts (theta, beta, shares of forces below
/// half the mean and below the mean, F(r) within 3 d), and of F(r) its highest bin, where that
/// lies, its plateau (mean over 4 to 6 d) and both its peak and its value at 3 d over the plateau.
/// Always the same names in the same order.
std::vector<NamedNumber> numbers_of(const Analysis& analysis);

/// A bed of an ensemble at one instant.
struct Member {
  Snapshot snapshot;
  Analysis analysis;
};

/// Analyses of an ensemble of beds: one snapshot is one draw, so every number comes as mean, spread
/// (standard deviation) and standard error over replicas.
class Ensemble {
 public:
  /// `columns` name a bed's place on the axes of its sweep.
  explicit Ensemble(std::vector<files::CsvColumn> columns) : columns_(std::move(columns)) {}

  using Labels = std::vector<std::string>;

  /// `instant` in cycles. Distributions, correlations and counts by pass are those of the earliest
  /// instant of a place.
  void add(const Labels& place, double instant, Member member);

  /// cycle        one row a place and instant: every number, NAME_sd and NAME_se
  /// numbers      one row a number of the earliest instant, beside what `reference` says of it
  /// passes       Table II at the earliest instant, beside what `reference` says
  /// pdf          P(f) by set of contacts, its spread, the mean fits, and the published laws
  /// fits         parameters by set, form and method: mean and spread
  /// correlation  F(r) by set
  /// edges        contacts above the mean force, end to end, of the first replica
  /// grains       where its grains are
  /// `reference`: columns `quantity` (names as in `numbers_of`), `paper`, `source`, and any of the
  /// places' columns; an empty table for none.
  std::vector<NamedTable> tables(const files::CsvTable& reference) const;

 private:
  struct First {
    double instant;
    std::vector<Member> members;
  };
  std::vector<files::CsvColumn> columns_;
  std::vector<Labels> places_;  ///< in order of appearance
  std::map<Labels, std::map<double, std::vector<std::vector<NamedNumber>>>> numbers_;
  std::map<Labels, First> first_;
};

/// The parts of `Ensemble::tables` that are statistics of forces: rows of one place, whose cells
/// come first in every row.
void add_pdf_rows(files::CsvTable& table, const Ensemble::Labels& place,
                  const std::vector<Member>& members);
void add_fit_rows(files::CsvTable& table, const Ensemble::Labels& place,
                  const std::vector<Member>& members);
void add_correlation_rows(files::CsvTable& table, const Ensemble::Labels& place,
                          const std::vector<Member>& members);
std::vector<files::CsvColumn> pdf_columns();
std::vector<files::CsvColumn> fit_columns();
std::vector<files::CsvColumn> correlation_columns();

}  // namespace shakebed::fitting::networks
