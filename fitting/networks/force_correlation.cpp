#include "fitting/networks/force_correlation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>

#include "files/error.hpp"
#include "fitting/networks/box_tree.hpp"

namespace shakebed::fitting::networks {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// What nanoflann asks of a data set.
struct Cloud {
  std::vector<PlacedForce> contacts;
  std::size_t kdtree_get_point_count() const { return contacts.size(); }
  double kdtree_get_pt(std::size_t index, std::size_t axis) const {
    return contacts[index].midpoint[axis];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3>;

/// A result set of nanoflann that bins neighbours instead of listing them.
class Neighbours {
 public:
  using DistanceType = double;

  Neighbours(const Cloud& cloud, int sets, std::size_t bins, double bin_width)
      : cloud_(cloud),
        bins_(bins),
        per_width_(1 / bin_width),
        squared_reach_(bin_width * static_cast<double>(bins) * bin_width *
                       static_cast<double>(bins)),
        cells_(static_cast<std::size_t>(sets) * bins) {}

  void clear(std::size_t self) {
    self_ = self;
    std::ranges::fill(cells_, Cell{});
  }
  bool addPoint(double squared, std::size_t index) {
    const auto bin = static_cast<std::size_t>(std::sqrt(squared) * per_width_);
    if (index == self_ || bin >= bins_) return true;
    const PlacedForce& other = cloud_.contacts[index];
    const std::size_t at = static_cast<std::size_t>(other.first_set) * bins_ + bin;
    cells_[at].count += 1;
    cells_[at].force += other.f;
    return true;
  }
  double worstDist() const { return squared_reach_; }
  bool full() const { return true; }
  std::size_t size() const { return 0; }

  /// Neighbours that belong to `set` first, and the sum of their f.
  struct Cell {
    double count = 0;
    double force = 0;
  };
  const Cell& cell(std::size_t set, std::size_t bin) const { return cells_[set * bins_ + bin]; }

 private:
  const Cloud& cloud_;
  std::size_t bins_;
  double per_width_;
  double squared_reach_;
  std::size_t self_ = 0;
  std::vector<Cell> cells_;
};

/// Sums over the ordered pairs of one set, and over its contacts' numbers of neighbours.
struct Sums {
  std::vector<double> pairs, forces, squared_neighbours;
  double contacts = 0, f = 0, squared_f = 0;
};

/// Contacts in k-d order, so that a search and its neighbours are near each other in memory.
Cloud in_tree_order(std::span<const PlacedForce> contacts) {
  std::vector<Point> midpoints;
  for (const auto& contact : contacts) midpoints.push_back(contact.midpoint);
  const BoxTree tree(midpoints);
  Cloud cloud;
  for (const Index k : tree.order()) cloud.contacts.push_back(contacts[k]);
  return cloud;
}

std::vector<Sums> all_pairs(const Cloud& cloud, std::size_t sets, std::size_t bins,
                            double bin_width) {
  const std::vector<double> zero(bins, 0.0);
  std::vector<Sums> sums(sets, Sums{zero, zero, zero});
  if (cloud.contacts.empty()) return sums;
  constexpr std::size_t leaf = 64;  // most neighbours are within reach: fewer nodes, longer loops
  Tree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(leaf));
  Neighbours neighbours(cloud, static_cast<int>(sets), bins, bin_width);
  for (std::size_t self = 0; self < cloud.contacts.size(); ++self) {
    const PlacedForce& contact = cloud.contacts[self];
    neighbours.clear(self);
    tree.findNeighbors(neighbours, contact.midpoint.data(), nanoflann::SearchParams());
    for (std::size_t bin = 0; bin < bins; ++bin) {
      double count = 0, force = 0;
      for (std::size_t set = 0; set < sets; ++set) {
        count += neighbours.cell(set, bin).count;
        force += neighbours.cell(set, bin).force;
        if (static_cast<int>(set) < contact.first_set) continue;
        sums[set].pairs[bin] += count;
        sums[set].forces[bin] += contact.f * force;
        sums[set].squared_neighbours[bin] += count * count;
      }
    }
    for (auto set = static_cast<std::size_t>(contact.first_set); set < sets; ++set) {
      sums[set].contacts += 1;
      sums[set].f += contact.f;
      sums[set].squared_f += contact.f * contact.f;
    }
  }
  return sums;
}

/// With f = m + e, sum_{i<j} f_i f_j = m^2 P + m sum_i e_i n_i + sum_{i<j} e_i e_j over P pairs,
/// n_i of them with contact i. Dealing the same forces at random, sum e = 0 takes the mean of n_i
/// out of the second term: variance = s^2 (m^2 sum (n_i - n)^2 + s^2 P).
double scatter(const Sums& sums, std::size_t bin) {
  const double pairs = sums.pairs[bin] / 2, n = sums.contacts, m = sums.f / n;
  const double s2 = std::max(0.0, sums.squared_f / n - m * m);
  const double uneven =
      std::max(0.0, sums.squared_neighbours[bin] - sums.pairs[bin] * sums.pairs[bin] / n);
  return std::sqrt(s2 * (m * m * uneven + s2 * pairs)) / pairs;
}

std::size_t number_of_bins(double bin_width, double reach) {
  if (!(bin_width > 0) || !std::isfinite(bin_width)) {
    throw files::bad_input("correlation bin width", "expected a number > 0");
  }
  constexpr double most_bins = 10'000;
  if (!(reach >= bin_width) || reach / bin_width > most_bins) {
    throw files::bad_input("correlation reach", "expected between 1 and 10,000 bin widths");
  }
  return static_cast<std::size_t>(std::llround(reach / bin_width));
}

}  // namespace

std::vector<ForceCorrelation> force_correlations(std::span<const PlacedForce> contacts, int sets,
                                                 double bin_width, double reach) {
  const std::size_t bins = number_of_bins(bin_width, reach);
  const auto sums =
      all_pairs(in_tree_order(contacts), static_cast<std::size_t>(sets), bins, bin_width);
  std::vector<ForceCorrelation> found;
  for (const Sums& set : sums) {
    ForceCorrelation correlation;
    correlation.bin_width = bin_width;
    for (std::size_t bin = 0; bin < bins; ++bin) {
      const bool empty = set.pairs[bin] == 0;
      correlation.pairs.push_back(static_cast<std::size_t>(set.pairs[bin] / 2));
      correlation.F.push_back(empty ? not_a_number : set.forces[bin] / set.pairs[bin]);
      correlation.uncorrelated_scatter.push_back(empty ? not_a_number : scatter(set, bin));
    }
    found.push_back(std::move(correlation));
  }
  return found;
}

ForceCorrelation mean_over_replicas(std::span<const ForceCorrelation> replicas) {
  ForceCorrelation mean;
  if (replicas.empty()) return mean;
  mean.bin_width = replicas.front().bin_width;
  for (const auto& one : replicas) {
    if (one.bin_width != mean.bin_width || one.F.size() != replicas.front().F.size()) {
      throw files::bad_input("force correlation", "replicas have different bins");
    }
  }
  for (std::size_t bin = 0; bin < replicas.front().F.size(); ++bin) {
    double n = 0, sum = 0, squares = 0;
    std::size_t pairs = 0;
    for (const auto& one : replicas) {
      pairs += one.pairs[bin];
      if (std::isnan(one.F[bin])) continue;
      ++n;
      sum += one.F[bin];
    }
    const double average = n > 0 ? sum / n : not_a_number;
    for (const auto& one : replicas) {
      if (!std::isnan(one.F[bin])) squares += (one.F[bin] - average) * (one.F[bin] - average);
    }
    mean.pairs.push_back(pairs);
    mean.F.push_back(average);
    mean.uncorrelated_scatter.push_back(not_a_number);
    mean.standard_error.push_back(n > 1 ? std::sqrt(squares / (n - 1) / n) : not_a_number);
  }
  return mean;
}

}  // namespace shakebed::fitting::networks
