#pragma once

#include <string>
#include <vector>

#include "fitting/networks/components.hpp"
#include "fitting/networks/contacting_trees.hpp"
#include "fitting/networks/force_correlation.hpp"
#include "fitting/networks/force_fit.hpp"

namespace shakebed::fitting::networks {

struct AnalysisOptions {
  int passes = 5;
  double elongation = 1.2;       ///< Sun 2006
  double force_bin = 0.1;        ///< of f = F_n / mean(F_n)
  double correlation_bin = 0.1;  ///< [median grain diameter]
  double correlation_reach = 6;  ///< [median grain diameter]; inside Sun's column of radius 6.1
};

/// The distribution of f over one set of contacts and its fits by both methods.
struct ForceDistribution {
  double mean_force = 0;    ///< the scale of f
  std::size_t forces = 0;   ///< f >= 0
  std::size_t pulling = 0;  ///< f < 0, left out of histogram and fits, but not of the mean
  ForceHistogram histogram;
  ForceFit by_histogram, by_likelihood;                  ///< Eq. 11
  ForceFit shifted_by_histogram, shifted_by_likelihood;  ///< Eq. 13
};

/// A published law beside these forces: chi^2 of the law as printed, ln L of it normalised.
struct Comparison {
  std::string source;
  ForceFit fit;
};

/// All that `shakebed network` finds in one snapshot.
struct Analysis {
  AnalysisOptions options;
  double median_diameter = 0;
  ForceNetworks networks;
  ForceDistribution all;              ///< contacts of all networks; f by their mean
  ForceDistribution largest;          ///< contacts of the largest; f by its own mean
  std::vector<Comparison> published;  ///< on `all`
  std::vector<SpanningTree> trees;
  ContactingTrees contacting;
  /// Of the contacts captured by passes 1 .. p, f by the mean of all (so that a preference of the
  /// trees for strong contacts shows as a shift, Figs 14 and 15).
  std::vector<ForceDistribution> by_pass;
  /// Of passes 1 .. p, p = 1 .. passes, and last of all contacts; lengths in median diameters.
  std::vector<ForceCorrelation> correlation;
};

/// Works out everything. A snapshot without contacts, or with one grain, has a defined, empty
/// result: no networks, counts of 0, fits with a `failure`.
Analysis analyse(const Snapshot& snapshot, const AnalysisOptions& options);

/// Mean and spread over replicas of one number of their analyses.
struct Spread {
  double mean = 0;
  double standard_deviation = 0;  ///< NaN for one replica
  std::size_t replicas = 0;
};
Spread spread(const std::vector<double>& values);

}  // namespace shakebed::fitting::networks
