#include "fitting/profile_likelihood.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "fitting/gsl.hpp"

namespace shakebed::fitting {
namespace {

/// chi^2 with one parameter held, minimised over the others, less its threshold. Descents start
/// from the last accepted place, so that the profile is one continuous branch.
class Profile {
 public:
  Profile(const Model& model, const Observations& data, const LeastSquaresFit& fit,
          std::size_t parameter, double threshold)
      : model_(model),
        data_(data),
        accepted_(fit.values),
        fixed_(fit.values.size(), false),
        parameter_(parameter),
        threshold_(threshold) {
    fixed_[parameter] = true;
  }

  double excess(double held) {
    auto start = accepted_;
    start[parameter_] = held;
    const Descent descent = descend(model_, data_, std::move(start), fixed_);
    last_ = descent.values;
    return descent.chi_squared - threshold_;
  }
  void accept_last() { accepted_ = last_; }
  double accepted() const { return accepted_[parameter_]; }

 private:
  const Model& model_;
  const Observations& data_;
  std::vector<double> accepted_;
  std::vector<double> last_;
  std::vector<bool> fixed_;
  std::size_t parameter_;
  double threshold_;
};

/// Where the profile passes zero between the accepted place and `outside`.
double crossing(Profile& profile, double outside) {
  gsl_function objective;
  objective.function = [](double held, void* self) {
    return static_cast<Profile*>(self)->excess(held);
  };
  objective.params = &profile;
  const double inside = profile.accepted();
  const auto finder = gsl::owned<gsl::RootFinder>(gsl_root_fsolver_alloc(gsl_root_fsolver_brent));
  const std::string doing = "the end of a profile-likelihood interval";
  gsl::check(gsl_root_fsolver_set(finder.get(), &objective, std::min(inside, outside),
                                  std::max(inside, outside)),
             doing);
  for (int i = 0; i < 60; ++i) {
    gsl::check(gsl_root_fsolver_iterate(finder.get()), doing);
    const double lower = gsl_root_fsolver_x_lower(finder.get());
    const double upper = gsl_root_fsolver_x_upper(finder.get());
    if (upper - lower <= 1e-4 * std::abs(outside - inside)) break;
  }
  return gsl_root_fsolver_root(finder.get());
}

/// Steps outward from the estimate until the profile passes its threshold. `step` is signed.
double end_of_interval(const Model& model, const Observations& data, const LeastSquaresFit& fit,
                       std::size_t parameter, double threshold, double step) {
  Profile profile(model, data, fit, parameter, threshold);
  const double best = fit.values[parameter];
  for (double steps = 1; steps <= 40; steps *= 1.4) {
    const double excess = profile.excess(best + steps * step);
    if (!std::isfinite(excess)) break;
    if (excess > 0) return crossing(profile, best + steps * step);
    profile.accept_last();
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
