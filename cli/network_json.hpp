#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "fitting/networks/analysis.hpp"

namespace shakebed::cli {

/// The contract of `shakebed network --json`: `networks` (their number), `largest` {grains,
/// contacts, coordination, strong_grains, extent, ...}, `mean_force` (over all contacts with
/// force), `pdf` {histogram, likelihood} of f = F_n / mean_force over the same contacts, each with
/// a, b, beta and their covariance in this order, and `mst`: per pass {NP, NE, NT, NE_rest,
/// missing}. A number that does not exist is null.
nlohmann::ordered_json network_json(const fitting::networks::Snapshot& snapshot,
                                    const fitting::networks::Analysis& analysis,
                                    const std::vector<std::string>& warnings);

}  // namespace shakebed::cli
