#include "fitting/profile_likelihood.hpp"

#include <cmath>
#include <limits>

#include "fitting/gsl.hpp"

namespace shakebed::fitting {
namespace {

/// chi^2 with one parameter held, minimised over the others, less its threshold; each step starts
/// where the last one ended.
class Profile {
 public:
  Profile(const Model& model, const Observations& data, const LeastSquaresFit& fit,
          std::size_t parameter, double threshold)
      : model_(model),
        data_(data),
        start_(fit.values),
        fixed_(fit.values.size(), false),
        parameter_(parameter),
        threshold_(threshold) {
    fixed_[parameter] = true;
  }

  double excess(double held) {
    start_[parameter_] = held;
    const Descent descent = descend(model_, data_, start_, fixed_);
    if (!std::isfinite(descent.chi_squared)) return std::numeric_limits<double>::infinity();
    start_ = descent.values;
    return descent.chi_squared - threshold_;
  }

 private:
  const Model& model_;
  const Observations& data_;
  std::vector<double> start_;
  std::vector<bool> fixed_;
  std::size_t parameter_;
  double threshold_;
};

double crossing(Profile& profile, double inside, double outside) {
  gsl_function objective;
  objective.function = [](double held, void* self) {
    return static_cast<Profile*>(self)->excess(held);
  };
  objective.params = &profile;
  const auto finder = gsl::owned<gsl::RootFinder>(gsl_root_fsolver_alloc(gsl_root_fsolver_brent));
  gsl::check(gsl_root_fsolver_set(finder.get(), &objective, std::min(inside, outside),
                                  std::max(inside, outside)),
             "the end of a profile-likelihood interval");
  for (int i = 0; i < 60; ++i) {
    gsl::check(gsl_root_fsolver_iterate(finder.get()), "the end of a profile-likelihood interval");
    const double lower = gsl_root_fsolver_x_lower(finder.get());
    const double upper = gsl_root_fsolver_x_upper(finder.get());
    if (gsl_root_test_interval(lower, upper, std::abs(outside - inside) * 1e-4, 0) == GSL_SUCCESS) {
      break;
    }
  }
  return gsl_root_fsolver_root(finder.get());
}

/// Steps outward from the estimate until the profile passes its threshold. `step` is signed.
double end_of_interval(const Model& model, const Observations& data, const LeastSquaresFit& fit,
                       std::size_t parameter, double threshold, double step) {
  Profile profile(model, data, fit, parameter, threshold);
  const double best = fit.values[parameter];
  const double farthest = 40 * std::abs(step);
  double inside = best;
  for (double distance = std::abs(step); distance <= farthest; distance *= 1.4) {
    const double held = best + std::copysign(distance, step);
    const double excess = profile.excess(held);
    if (!std::isfinite(excess)) break;
    if (excess > 0) {
      Profile fresh(model, data, fit, parameter, threshold);
      return crossing(fresh, inside, held);
    }
    inside = held;
  }
  return std::copysign(std::numeric_limits<double>::infinity(), step);
}

}  // namespace

std::vector<Interval> profile_intervals(const Model& model, const Observations& data,
                                        const LeastSquaresFit& fit, Scale scale) {
  const double factor = interval_factor(scale, fit.degrees_of_freedom);
  const double variance =
      scale == Scale::given ? 1 : fit.chi_squared / double(fit.degrees_of_freedom);
  const double threshold = fit.chi_squared + factor * factor * variance;
  std::vector<Interval> intervals;
  for (std::size_t k = 0; k < fit.values.size(); ++k) {
    const double step = factor * fit.standard_error(k);
    if (!(step > 1e-9 * std::abs(fit.values[k]))) {
      intervals.push_back({fit.values[k], fit.values[k]});  // exact data: nothing to bound
      continue;
    }
    intervals.push_back({end_of_interval(model, data, fit, k, threshold, -step),
                         end_of_interval(model, data, fit, k, threshold, step)});
  }
  return intervals;
}

}  // namespace shakebed::fitting
