#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shakebed::fitting {

/// Where a model's nonlinear parameter is looked for, and how the scan spaces its trials.
struct SearchInterval {
  double from;
  double to;
  bool logarithmic;
};

/// A fitting form y(x; parameters) that is linear in all parameters but one once that one is
/// given: y = sum_j coefficient_j basis_j(x; nonlinear). `assemble` turns the nonlinear parameter
/// and the linear coefficients into the parameters as printed. With that, variable projection
/// (Golub & Pereyra 1973) needs a scan over one number and no start values.
template <class M>
concept SeparableModel = requires(double x, double nonlinear,
                                  std::array<double, M::linear_count> coefficients,
                                  std::array<double, M::parameters.size()> values,
                                  const std::vector<double>& xs) {
  { M::name } -> std::convertible_to<std::string_view>;
  { M::parameters[0] } -> std::convertible_to<std::string_view>;
  { M::nonlinear } -> std::convertible_to<std::size_t>;
  { M::positive_x } -> std::convertible_to<bool>;
  { M::basis(x, nonlinear) } -> std::same_as<std::array<double, M::linear_count>>;
  {
    M::assemble(nonlinear, coefficients)
    } -> std::same_as<std::array<double, M::parameters.size()>>;
  { M::value(x, values) } -> std::same_as<double>;
  { M::gradient(x, values) } -> std::same_as<std::array<double, M::parameters.size()>>;
  { M::search(xs) } -> std::same_as<SearchInterval>;
  {
    M::units(std::string(), std::string())
    } -> std::same_as<std::array<std::string, M::parameters.size()>>;
};

/// Any separable model under one type, so that least squares is compiled once.
class Model {
 public:
  template <SeparableModel M>
  static Model of() {
    Model model;
    model.name = M::name;
    model.parameters.assign(M::parameters.begin(), M::parameters.end());
    model.linear_count = M::linear_count;
    model.nonlinear = M::nonlinear;
    model.positive_x = M::positive_x;
    model.basis = [](double x, double b, std::span<double> out) {
      std::ranges::copy(M::basis(x, b), out.begin());
    };
    model.assemble = [](double b, std::span<const double> coefficients) {
      std::array<double, M::linear_count> fixed;
      std::copy_n(coefficients.begin(), fixed.size(), fixed.begin());
      const auto values = M::assemble(b, fixed);
      return std::vector<double>(values.begin(), values.end());
    };
    model.value = [](double x, std::span<const double> values) {
      return M::value(x, fixed_size<M>(values));
    };
    model.gradient = [](double x, std::span<const double> values, std::span<double> out) {
      std::ranges::copy(M::gradient(x, fixed_size<M>(values)), out.begin());
    };
    model.search = [](const std::vector<double>& xs) { return M::search(xs); };
    model.units = [](const std::string& x, const std::string& y) {
      const auto units = M::units(x, y);
      return std::vector<std::string>(units.begin(), units.end());
    };
    return model;
  }

  std::string name;
  std::vector<std::string> parameters;  ///< in the order they are printed
  std::size_t linear_count = 0;
  std::size_t nonlinear = 0;  ///< index of the nonlinear parameter among `parameters`
  bool positive_x = false;    ///< defined for x > 0 only
  std::function<void(double x, double nonlinear, std::span<double> out)> basis;
  std::function<std::vector<double>(double nonlinear, std::span<const double> coefficients)>
      assemble;
  std::function<double(double x, std::span<const double> values)> value;
  std::function<void(double x, std::span<const double> values, std::span<double> out)> gradient;
  std::function<SearchInterval(const std::vector<double>& xs)> search;
  std::function<std::vector<std::string>(const std::string& x, const std::string& y)> units;

 private:
  template <class M>
  static std::array<double, M::parameters.size()> fixed_size(std::span<const double> values) {
    std::array<double, M::parameters.size()> fixed;
    std::copy_n(values.begin(), fixed.size(), fixed.begin());
    return fixed;
  }
};

}  // namespace shakebed::fitting
