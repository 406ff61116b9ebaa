#pragma once

#include <gsl/gsl_errno.h>
#include <gsl/gsl_matrix.h>
#include <gsl/gsl_min.h>
#include <gsl/gsl_multifit.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <gsl/gsl_rng.h>
#include <gsl/gsl_roots.h>
#include <gsl/gsl_vector.h>

#include <memory>
#include <new>
#include <string>

#include "files/error.hpp"

// Thin owners of GSL's C objects. GSL's own handler aborts the program; `quiet()` turns it off and
// every status goes through `check`.
namespace shakebed::fitting::gsl {

template <auto free>
struct Deleter {
  template <class T>
  void operator()(T* object) const {
    free(object);
  }
};

using Vector = std::unique_ptr<gsl_vector, Deleter<gsl_vector_free>>;
using Matrix = std::unique_ptr<gsl_matrix, Deleter<gsl_matrix_free>>;
using LinearFit = std::unique_ptr<gsl_multifit_linear_workspace, Deleter<gsl_multifit_linear_free>>;
using NonlinearFit =
    std::unique_ptr<gsl_multifit_nlinear_workspace, Deleter<gsl_multifit_nlinear_free>>;
using Minimiser = std::unique_ptr<gsl_min_fminimizer, Deleter<gsl_min_fminimizer_free>>;
using RootFinder = std::unique_ptr<gsl_root_fsolver, Deleter<gsl_root_fsolver_free>>;
using RandomStream = std::unique_ptr<gsl_rng, Deleter<gsl_rng_free>>;

inline void quiet() {
  static const bool done = (gsl_set_error_handler_off(), true);
  (void)done;
}

/// `object` as an owner; std::bad_alloc when GSL could not allocate it.
template <class Owner, class T>
Owner owned(T* object) {
  if (object == nullptr) throw std::bad_alloc();
  return Owner(object);
}

inline Vector vector(std::size_t size) { return owned<Vector>(gsl_vector_calloc(size)); }
inline Matrix matrix(std::size_t rows, std::size_t columns) {
  return owned<Matrix>(gsl_matrix_calloc(rows, columns));
}

/// Throws Error(failed) with GSL's words when `status` is not success.
inline void check(int status, const std::string& doing) {
  if (status != GSL_SUCCESS) {
    throw files::failed("", doing + ": GSL reports \"" + gsl_strerror(status) + "\"");
  }
}

}  // namespace shakebed::fitting::gsl
