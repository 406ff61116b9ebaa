#include "fitting/networks/force_correlation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "files/error.hpp"
#include "fitting/networks/box_tree.hpp"

namespace shakebed::fitting::networks {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Contacts in the order of a k-d tree, coordinate by coordinate: neighbours lie side by side.
struct Cloud {
  explicit Cloud(std::span<const PlacedForce> contacts) : tree(midpoints(contacts)) {
    for (const Index k : tree.order()) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        place[axis].push_back(contacts[k].midpoint[axis]);
      }
      f.push_back(contacts[k].f);
      first_set.push_back(contacts[k].first_set);
    }
  }
  static std::vector<Point> midpoints(std::span<const PlacedForce> contacts) {
    std::vector<Point> places;
    for (const auto& contact : contacts) places.push_back(contact.midpoint);
    return places;
  }

  BoxTree tree;
  std::array<std::vector<double>, 3> place;
  std::vector<double> f;
  std::vector<int> first_set;
};

/// Sorts the neighbours of one contact after another into bins of distance.
class Neighbours {
 public:
  /// Neighbours that belong to a set first, and the sum of their f.
  struct Cell {
    double count = 0;
    double force = 0;
  };

  Neighbours(const Cloud& cloud, std::size_t sets, std::size_t bins, double bin_width)
      : cloud_(cloud),
        bins_(bins),
        per_width_(1 / bin_width),
        squared_reach_(std::pow(bin_width * static_cast<double>(bins), 2)),
        cells_(sets * bins) {}

  const Cell& cell(std::size_t set, std::size_t bin) const { return cells_[set * bins_ + bin]; }

  void look_around(Index self) {
    self_ = self;
    std::ranges::fill(cells_, Cell{});
    descend(0);
  }

 private:
  /// Small enough to keep most of a block within reach, long enough for vector arithmetic.
  static constexpr Index block = 64;

  void descend(Index n) {
    const auto& node = cloud_.tree.nodes()[n];
    if (near(node, cloud_.tree.point(self_)) >= squared_reach_) return;
    if (node.leaf() || node.end - node.begin <= block) {
      sort_into_bins(node.begin, node.end);
    } else {
      descend(node.left);
      descend(node.right);
    }
  }

  void sort_into_bins(Index begin, Index end) {
    const Point& here = cloud_.tree.point(self_);
    const auto& [x, y, z] = cloud_.place;
    const double too_far = 4 * squared_reach_;  // a bound that an int can hold after division
    std::array<int, block> bin;
    for (Index k = begin; k < end; ++k) {
      const double dx = x[k] - here[0], dy = y[k] - here[1], dz = z[k] - here[2];
      const double squared = std::min(dx * dx + dy * dy + dz * dz, too_far);
      bin[k - begin] = static_cast<int>(std::sqrt(squared) * per_width_);
    }
    for (Index k = begin; k < end; ++k) {
      const auto at = static_cast<std::size_t>(bin[k - begin]);
      if (at >= bins_ || k == self_) continue;
      Cell& cell = cells_[static_cast<std::size_t>(cloud_.first_set[k]) * bins_ + at];
      cell.count += 1;
      cell.force += cloud_.f[k];
    }
  }

  const Cloud& cloud_;
  std::size_t bins_;
  double per_width_;
  double squared_reach_;
  Index self_ = 0;
  std::vector<Cell> cells_;
};

/// Sums over the ordered pairs of one set, and over its contacts' numbers of neighbours.
struct Sums {
  std::vector<double> pairs, forces, squared_neighbours;
  double contacts = 0, f = 0, squared_f = 0;
};

std::vector<Sums> all_pairs(const Cloud& cloud, std::size_t sets, std::size_t bins,
                            double bin_width) {
  const std::vector<double> zero(bins, 0.0);
  std::vector<Sums> sums(sets, Sums{zero, zero, zero});
  Neighbours neighbours(cloud, sets, bins, bin_width);
  for (Index self = 0; self < cloud.f.size(); ++self) {
    const double f = cloud.f[self];
    const auto first_set = static_cast<std::size_t>(cloud.first_set[self]);
    neighbours.look_around(self);
    for (std::size_t bin = 0; bin < bins; ++bin) {
      double count = 0, force = 0;
      for (std::size_t set = 0; set < sets; ++set) {
        count += neighbours.cell(set, bin).count;
        force += neighbours.cell(set, bin).force;
        if (set < first_set) continue;
        sums[set].pairs[bin] += count;
        sums[set].forces[bin] += f * force;
        sums[set].squared_neighbours[bin] += count * count;
      }
    }
    for (std::size_t set = first_set; set < sets; ++set) {
      sums[set].contacts += 1;
      sums[set].f += f;
      sums[set].squared_f += f * f;
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
  const auto sums = all_pairs(Cloud(contacts), static_cast<std::size_t>(sets), bins, bin_width);
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
