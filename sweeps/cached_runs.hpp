#pragma once

#include <set>
#include <string>
#include <vector>

#include "simulator/record.hpp"
#include "sweeps/collect.hpp"
#include "sweeps/grid.hpp"
#include "sweeps/store/cache.hpp"

namespace shakebed::sweeps {

/// W, Gamma, V_p, layers and grains: what is known of a point without running it.
std::vector<simulator::Scalar> point_scalars(const simulator::Scene& scene);

/// The cached runs of a grid, read point by point, and who made them.
class CachedRuns {
 public:
  CachedRuns(const Grid& grid, const store::Cache& cache)
      : grid_(grid), cache_(cache), runs_(runs_of(grid)) {
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      if (runs_[k].replicate == 0) first_run_.push_back(k);
    }
  }

  std::size_t points() const { return grid_.points.size(); }
  const Point& point(std::size_t k) const { return grid_.points[k]; }

  /// Those of one point, replicate by replicate; present and missing ones are counted, and files
  /// that cannot be used are named, in `collected`.
  std::vector<simulator::Record> records(std::size_t point, Collected& collected);

  /// Provenance lines of a table made of all that was read.
  std::vector<std::string> provenance(const Collected& collected) const;

 private:
  const Grid& grid_;
  const store::Cache& cache_;
  std::vector<Run> runs_;
  std::vector<std::size_t> first_run_;  ///< of each point
  std::set<std::string> revisions_;
  std::set<std::string> machines_;
  std::set<std::string> flags_;
  std::string all_keys_;
};

}  // namespace shakebed::sweeps
