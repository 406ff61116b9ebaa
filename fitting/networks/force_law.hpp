#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace shakebed::fitting::networks {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// The distribution of scaled normal forces f = F_n / mean(F_n) >= 0,
///     P(f) = a (1 - b exp(-(f - theta)^2)) exp(-beta f),
/// Eq. 11 of Sun et al., PRE 74, 061307 (2006) (from Mueth et al., PRE 57, 3164 (1998)) with
/// theta = 0, and with a free theta its Eq. 13. Eq. 13 has exp(-beta (f - lambda)), but `a` and
/// lambda enter only as a exp(beta lambda): the shift is undetermined and `a` here is that product
/// (see `shift_of`). A density needs b <= 1, and `integral() == 1`, which the paper's printed
/// triples need not have.
struct ForceLaw {
  double a = 0;
  double b = 0;
  double beta = 1;
  double theta = 0;

  double density(double f) const;
  double integral(double from, double to) const;  ///< of P; `to` may be infinite
  double integral() const;                        ///< over f >= 0; 1 for a normalised law
  double mean() const;  ///< integral of f P over f >= 0, divided by `integral()`
  /// lambda of Eq. 13 when its own factor is held at `printed_a`: a = printed_a exp(beta lambda).
  double shift_of(double printed_a) const;
};

/// The law with `a` set by normalisation: integral() == 1.
ForceLaw normalised(double b, double beta, double theta = 0);

/// M_k = integral of f^k exp(-(f - theta)^2 - beta f) from `from` to `to` (which may be infinite),
/// in closed form.
struct GaussianMoments {
  double M0, M1, M2;
};
GaussianMoments gaussian_moments(double beta, double theta, double from, double to);

/// A triple as printed, for comparison.
struct PublishedLaw {
  std::string source;
  ForceLaw law;
};
/// Sun 2006 prints b = 0.83 in its text and 0.68 in the caption of Fig. 12; Mueth 1998.
std::vector<PublishedLaw> published_laws();

/// What Sun 2006 prints of P(f) of all contacts (pass 0) and of those of passes 1 .. p: the fit of
/// the whole range (for pass 0 the caption's triple), and another one (for pass 0 the text's
/// triple, for passes 1 and 2 that of all contacts shifted so that it fits the tail).
struct PublishedPassLaws {
  std::optional<ForceLaw> whole;
  std::optional<ForceLaw> other;
};
PublishedPassLaws published_law_of_pass(int pass);

}  // namespace shakebed::fitting::networks
