#pragma once

#include "fitting/least_squares.hpp"

namespace shakebed::fitting {

/// 95 % profile-likelihood interval of every parameter of `fit` (see fit_least_squares). An end
/// that is not found within 40 standard errors is infinite: the data do not bound it.
std::vector<Interval> profile_intervals(const Model& model, const Observations& data,
                                        const LeastSquaresFit& fit, Scale scale);

}  // namespace shakebed::fitting
