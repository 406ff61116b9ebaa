#pragma once

#include <functional>
#include <string>
#include <vector>

namespace shakebed::fitting::claims {

/// A function of formulas: columns in, one number out.
struct Function {
  std::string name;
  std::size_t arguments;
  std::function<double(const std::vector<std::vector<double>>&)> value;
};

/// mean(y), sum(y), largest(y), smallest(y), count(y), spread(y) = largest - smallest;
/// log(y) and abs(y) of one number; slope(x, y) of the least-squares line of y against x;
/// at_largest(x, y): x where y is largest; interpolated(x, y, x0): on straight lines between
/// points.
///
/// Of a curve y(x) with its points in order of x: second_peak(x, y) is the largest rise of y above
/// a dip on the way from its highest point, over the height of that point (0: none), and
/// second_peak_at(x, y) the x that it leads to. Errors of y make it larger than it is, by a few
/// standard errors: bounds on it stand well above them.
const std::vector<Function>& functions();

}  // namespace shakebed::fitting::claims
