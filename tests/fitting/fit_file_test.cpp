#include "fitting/fit_file.hpp"

#include <catch2/catch.hpp>

#include "files/error.hpp"

using namespace shakebed::fitting;

namespace {

FitFile read(const std::string& text) { return read_fit_text(text, "fits/f.yaml"); }

std::string one_fit(const std::string& lines) {
  return "fit: 1\nid: f\ndata: ../data/t.csv\nfits:\n  - id: one\n    x: W\n    y: T_z_scaled\n"
         "    model: algebraic\n" +
         lines;
}

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const shakebed::files::Error& error) {
    CHECK(error.kind() == shakebed::files::Error::Kind::bad_input);
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("a fit file is read with its defaults", "[fit_file]") {
  const auto file = read(
      "fit: 1\nid: f\ndata: ../data/t.csv\n"
      "defaults: {x: V_p, y: T_z, model: power_law, range: {W: [peak, W_2], stretch: [0.7]}}\n"
      "fits:\n"
      "  - {id: a, select: {system: 2D rough}}\n"
      "  - {id: b, y: delta_h_cm, y_error: none, method: [linear, log_log], model: power_law}\n"
      "peaks:\n  - {id: p, y: T_z_scaled}\n");
  CHECK(file.data == "fits/../data/t.csv");
  REQUIRE(file.fits.size() == 2);
  const auto& a = file.fits[0];
  CHECK(a.rows.select[0].value == "2D rough");
  CHECK(a.y_error == "T_z_se");
  CHECK(a.weights == std::vector{Weights::errors});
  CHECK(a.methods == std::vector{Method::log_log});
  CHECK(a.range.from.kind == RangeBound::Kind::peak);
  CHECK(a.range.to.kind == RangeBound::Kind::W_2);
  CHECK(a.peak_of == "T_z_scaled");
  const auto& b = file.fits[1];
  CHECK(b.y == "delta_h_cm");
  CHECK(b.y_error.empty());
  CHECK(b.weights == std::vector{Weights::equal});
  CHECK(b.methods == std::vector{Method::linear, Method::log_log});
  CHECK(file.peaks.size() == 1);
}

TEST_CASE("printed values carry half a unit of their last digit", "[fit_file]") {
  const auto fit = read(one_fit("    reference: {a: 0.054, c: 7.98, source: Table III}\n")).fits[0];
  CHECK(fit.reference.parameters.at("a").half_unit == Approx(0.0005));
  CHECK(fit.reference.parameters.at("c").half_unit == Approx(0.005));
}

TEST_CASE("faults in a fit file are refused with their place", "[fit_file]") {
  const auto has = [](const std::string& text) { return Catch::Contains(text); };
  CHECK_THAT(refusal(one_fit("    wieghts: equal\n")), has("f.yaml:9:") && has("weights"));
  CHECK_THAT(refusal(one_fit("    weights: eqaul\n")), has("f.yaml:9:14") && has("equal"));
  CHECK_THAT(refusal(one_fit("    method: log_log\n")), has("log_log fits a power_law"));
  CHECK_THAT(refusal(one_fit("    range: {W: [9, 2]}\n")), has("the range is empty"));
  CHECK_THAT(refusal(one_fit("    range: {W: [peek, 2]}\n")), has("f.yaml:9:17") && has("peek"));
  CHECK_THAT(refusal(one_fit("    range: {V_p: [peak, 2]}\n")), has("range in W, not in V_p"));
  CHECK_THAT(refusal(one_fit("    range: {W: [2]}\n")), has("expected [from, to]"));
  CHECK_THAT(refusal(one_fit("    range: {W: [2, 9], stretch: [0]}\n")), has("positive number"));
  CHECK_THAT(refusal(one_fit("    weights: []\n")), has("at least one"));
  CHECK_THAT(refusal(one_fit("    y_error: none\n    weights: errors\n")),
             has("needs a y_error column"));
  CHECK_THAT(refusal(one_fit("    covariance: given\n    weights: equal\n")),
             has("needs `weights: errors`"));
  CHECK_THAT(refusal(one_fit("    reference: {alpha: 2, source: x}\n")), has("alpha"));
  CHECK_THAT(refusal(one_fit("    exclude: [{W: [1, 2]}]\n")), has("because"));
  CHECK_THAT(refusal(one_fit("    minimum_stationary: 2\n")), has("a share above 0"));
  CHECK_THAT(refusal(one_fit("  - {id: one, x: W, y: T_z, model: algebraic}\n")),
             has("used twice"));
  CHECK_THAT(refusal("fit: 2\nid: f\nfits: []\n"), has("f.yaml:1:6") && has("schema 1"));
  CHECK_THAT(refusal("fit: 1\nid: f\n"), has("nothing to do"));
  CHECK_THAT(refusal("fit: 1\nid: f\nfits:\n  - {id: a, x: W, y: T_z}\n"),
             has("f.yaml:4:") && has("model"));
  CHECK_THAT(refusal("fit: 1\nid: f\nfits:\n  - {id: a, x: W, y: T_z, model: expnential}\n"),
             has("did you mean exponential"));
}
