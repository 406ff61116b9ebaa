#pragma once

#include <string>
#include <vector>

#include "files/csv.hpp"

namespace shakebed::fitting::trade {

/// How T_z of one scene goes with one numerical setting v, from a trade table (sweeps/trade.hpp):
///   T_z = T_0 (1 + c x(v)),
/// x = (dt/t_c)^2 for steps, as the integrator is of second order, and x = (k_n/k_scene)^(-1/2) for
/// stiffness, as what contacts change goes with the time and the depth they take. Both powers are
/// fitted freely by fitting/trade/orders.yaml. Weighted linear least squares; where the points
/// scatter more than their errors, the error of c is enlarged by sqrt(chi^2/dof).
struct BiasLaw {
  std::string scene;
  std::string axis;
  double coefficient;  ///< c [1]
  double error;        ///< its standard error
  double chi_squared;
  std::size_t degrees_of_freedom;
  /// The scene's numbers as the trade table has them: dimension, rough, W, layers, restitution,
  /// amplitude; empty where it has not.
  std::vector<std::string> numbers;
};

/// x(v) of an axis.
double abscissa(const std::string& axis, double value);

/// The laws of `axis`, scene by scene. Scenes with fewer than three points are left out.
std::vector<BiasLaw> bias_laws(const files::CsvTable& table, const std::string& axis);

/// A bound on |bias| at x = 1: the largest |c| + 1.64 standard errors of all scenes, so that each
/// scene's own bias stays below it with a chance of 95 % at least.
double bias_bound(const std::vector<BiasLaw>& laws);

/// scene, axis, its numbers, c, its error, chi^2, degrees of freedom.
files::CsvTable law_table(const std::vector<BiasLaw>& laws);

/// What scenes with `accuracy` choose from: axis, value, bound on the bias of T_z [%], CPU time
/// beside the reference (geometric mean over the scenes), and the number of scenes. Scenes with
/// W < 5 are left out.
files::CsvTable accuracy_table(const files::CsvTable& table);

}  // namespace shakebed::fitting::trade
