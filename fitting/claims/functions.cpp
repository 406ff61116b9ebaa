#include "fitting/claims/functions.hpp"

#include <gsl/gsl_fit.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "files/error.hpp"

namespace shakebed::fitting::claims {
namespace {

using Values = std::vector<double>;
using Arguments = std::vector<Values>;

double largest(const Values& y) { return *std::ranges::max_element(y); }
double smallest(const Values& y) { return *std::ranges::min_element(y); }
double sum(const Values& y) { return std::accumulate(y.begin(), y.end(), 0.0); }
std::size_t highest(const Values& y) {
  return std::size_t(std::ranges::max_element(y) - y.begin());
}

void need_pairs(const Arguments& a, std::size_t least) {
  if (a[0].size() != a[1].size() || a[0].size() < least) {
    throw files::failed("", "expected " + std::to_string(least) +
                                " or more pairs of x and y, got " + std::to_string(a[0].size()) +
                                " and " + std::to_string(a[1].size()) + " numbers");
  }
}

double slope(const Arguments& a) {
  need_pairs(a, 2);
  double intercept = 0, gradient = 0, v00 = 0, v01 = 0, v11 = 0, squares = 0;
  gsl_fit_linear(a[0].data(), 1, a[1].data(), 1, a[0].size(), &intercept, &gradient, &v00, &v01,
                 &v11, &squares);
  return gradient;
}

double interpolated(const Arguments& a) {
  need_pairs(a, 2);
  const auto& [x, y, at] = std::tie(a[0], a[1], a[2]);
  for (std::size_t k = 1; k < x.size(); ++k) {
    if (at[0] < x[k - 1] || at[0] > x[k]) continue;
    return y[k - 1] + (y[k] - y[k - 1]) * (at[0] - x[k - 1]) / (x[k] - x[k - 1]);
  }
  throw files::failed("", "the place to interpolate at lies outside the points");
}

/// Largest rise above a dip, going away from the highest point on either side.
struct Rise {
  double height = 0;
  std::size_t at = 0;
};
Rise second_rise(const Arguments& a) {
  need_pairs(a, 3);
  const Values& y = a[1];
  const std::size_t top = highest(y);
  Rise best{0, top};
  const auto walk = [&](auto next, auto inside) {
    double dip = y[top];
    for (std::size_t k = top; inside(k); k = next(k)) {
      dip = std::min(dip, y[k]);
      if (y[k] - dip > best.height) best = {y[k] - dip, k};
    }
  };
  walk([](std::size_t k) { return k + 1; }, [&](std::size_t k) { return k < y.size(); });
  walk([](std::size_t k) { return k - 1; }, [&](std::size_t k) { return k < y.size(); });
  return best;
}

}  // namespace

const std::vector<Function>& functions() {
  static const std::vector<Function> all{
      {"mean", 1, [](const Arguments& a) { return sum(a[0]) / double(a[0].size()); }},
      {"sum", 1, [](const Arguments& a) { return sum(a[0]); }},
      {"largest", 1, [](const Arguments& a) { return largest(a[0]); }},
      {"smallest", 1, [](const Arguments& a) { return smallest(a[0]); }},
      {"spread", 1, [](const Arguments& a) { return largest(a[0]) - smallest(a[0]); }},
      {"count", 1, [](const Arguments& a) { return double(a[0].size()); }},
      {"log", 1, [](const Arguments& a) { return std::log(a[0][0]); }},
      {"abs", 1, [](const Arguments& a) { return std::abs(a[0][0]); }},
      {"slope", 2, slope},
      {"at_largest", 2,
       [](const Arguments& a) {
         need_pairs(a, 1);
         return a[0][highest(a[1])];
       }},
      {"interpolated", 3, interpolated},
      {"second_peak", 2, [](const Arguments& a) { return second_rise(a).height / largest(a[1]); }},
      {"second_peak_at", 2, [](const Arguments& a) { return a[0][second_rise(a).at]; }},
  };
  return all;
}

}  // namespace shakebed::fitting::claims
