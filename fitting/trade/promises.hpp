#pragma once

#include <string>
#include <vector>

#include "files/csv.hpp"

namespace shakebed::fitting::trade {

/// How many runs kept their promise |T_z/T_z,ref - 1| <= asked, and the chance of so few if each
/// kept it with 95 %.
struct Kept {
  std::string scene;  ///< `all` in the last row
  std::string asked;  ///< `all` in the last row
  std::size_t runs = 0;
  std::size_t kept = 0;
  double mean_error = 0;       ///< mean of T_z/T_z,ref - 1: what bias remains
  double largest_error = 0;    ///< largest |T_z/T_z,ref - 1|
  double reference_error = 0;  ///< standard error of T_z,ref, as a share
  double chance = 1;           ///< P(X <= kept), X ~ binomial(runs, 0.95)
};

/// `runs`: columns scene, asked ("5 %"), T_z; `references`: columns scene, T_z, T_z_se.
std::vector<Kept> kept_promises(const files::CsvTable& runs, const files::CsvTable& references);

files::CsvTable promises_table(const std::vector<Kept>& kept);

}  // namespace shakebed::fitting::trade
