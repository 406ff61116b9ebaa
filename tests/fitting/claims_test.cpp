#include <catch2/catch.hpp>
#include <cmath>

#include "fitting/claims/claim.hpp"
#include "fitting/claims/evaluate.hpp"

namespace shakebed::fitting::claims {
namespace {

/// Beds "a" and "b" at x = 1, 2, 3, with y = 10, 20, 15 and 1, 4, 2; one more of "b" is at rest.
files::CsvTable beds() {
  files::CsvTable table(
      {{"bed", ""}, {"x", "1"}, {"y", "d"}, {"y_se", "d"}, {"stationary", "1"}, {"at_rest", "1"}});
  table.add_row({"a", "1", "10", "0.1", "1", "0"});
  table.add_row({"a", "2", "20", "0.1", "1", "0"});
  table.add_row({"a", "3", "15", "0.1", "1", "0"});
  table.add_row({"b", "1", "1", "0.1", "1", "0"});
  table.add_row({"b", "2", "4", "0.1", "1", "0"});
  table.add_row({"b", "3", "2", "0.1", "1", "0"});
  table.add_row({"b", "4", "99", "0.1", "1", "1"});
  return table;
}

double value_of(const std::string& text, bool steady_only = true) {
  const auto table = beds();
  Evaluation evaluation({{"table", &table}}, steady_only);
  return evaluation.number(read_formula(text, "test"));
}

Claim claim_of(const std::string& compute, const std::string& holds) {
  return read_claim(files::YamlNode::load_text(
      "id: c\nsays: s\nsource: Sec. 1\nunit: d\ntable: t\nwhy: w\ncompute: '" + compute +
          "'\nholds: " + holds + "\n",
      "claims.yaml"));
}

Result judged(const std::string& compute, const std::string& holds) {
  const auto table = beds();
  return judge(claim_of(compute, holds),
               [&](const std::string& name) { return name == "t" ? &table : nullptr; });
}

}  // namespace

TEST_CASE("Formulas over columns, rows and groups") {
  CHECK(value_of("1 + 2 * 3 - 8 / 4 / 2") == 6);
  CHECK(value_of("-(1 - 3) * 1e2") == 200);
  CHECK(value_of("mean(y[bed = a])") == 15);
  CHECK(value_of("y[bed = a, x = 2] / y[bed = b, x = 2]") == 5);
  CHECK(value_of("sum(y[bed = a] * x[bed = a])") == 10 + 40 + 45);
  CHECK(value_of("count(y[x >= 2])") == 4);
  CHECK(value_of("count(y[x > 2, bed != b])") == 1);
  CHECK(value_of("largest(y)") == 20);
  CHECK(value_of("largest(y)", false) == 99);
  CHECK(value_of("mean(each(bed: y[x = 3] / y[x = 1]))") == (1.5 + 2) / 2);
  CHECK(value_of("smallest(each(bed: at_largest(x, y)))") == 2);
  CHECK(value_of("slope(x, y)[bed = a]") == Approx(2.5));
  CHECK(value_of("interpolated(x, y, 2.5)[bed = a]") == 17.5);
  CHECK(value_of("spread(y[bed = b])") == 3);
}

TEST_CASE("A second peak is the largest rise after a dip, on either side of the highest point") {
  files::CsvTable table({{"x", "1"}, {"y", "1"}});
  const double y[] = {3, 1, 4, 10, 6, 2, 7, 5, 5.5, 0};
  for (int k = 0; k < 10; ++k) table.add_row({std::to_string(k), files::number_text(y[k])});
  Evaluation evaluation({{"t", &table}}, true);
  const auto peak = read_formula("second_peak(x, y)", "test");
  const auto place = read_formula("second_peak_at(x, y)", "test");
  CHECK(evaluation.number(peak) == 0.5);  // from 2 up to 7, of 10
  CHECK(evaluation.number(place) == 6);
  const auto left = read_formula("second_peak_at(x, y)[x <= 4]", "test");
  CHECK(evaluation.number(left) == 0);  // from 1 up to 3
}

TEST_CASE("What a formula cannot mean is refused at its place") {
  const auto table = beds();
  for (const auto& [text, words] : std::vector<std::pair<std::string, std::string>>{
           {"mean(y", "expected ')'"},
           {"y[bed ~ a]", "one of ="},
           {"1 2", "the end or an operator"},
           {"y[x = ]", "a word or a number"},
           {"mean(stationry)", "did you mean"},
           {"median(y)", "no function median"},
           {"y", "6 numbers where one"},
           {"mean(y[bed = c])", "no row has a number in 'y' [bed = c]"},
       }) {
    CAPTURE(text);
    std::string what;
    try {
      const auto formula = read_formula(text, "claims.yaml:1:1");
      Evaluation({{"t", &table}}, true).number(formula);
    } catch (const files::Error& error) {
      what = error.faults().front().what;
    }
    CHECK_THAT(what, Catch::Contains(words));
  }
}

TEST_CASE("Verdicts follow the 95 % interval, and errors are propagated") {
  // The mean of three numbers with errors of 0.1: 15 +- 0.1/sqrt(3). 400 draws give the error to
  // 3.5 %; the stream is fixed, so nothing here is left to chance.
  const auto mean = judged("mean(y[bed = a])", "{from: 14.5, to: 15.5}");
  CHECK(mean.value == 15);
  CHECK(mean.standard_error == Approx(0.1 / std::sqrt(3.0)).epsilon(0.1));
  CHECK(mean.verdict == Verdict::holds);
  CHECK(judged("mean(y[bed = a])", "{above: 15.2}").verdict == Verdict::differs);
  CHECK(judged("mean(y[bed = a])", "{below: 15.02}").verdict == Verdict::not_decided);
  // A cell is drawn once: it cancels against itself.
  CHECK(judged("y[bed = a, x = 1] - y[bed = a, x = 1] + 1", "{above: 0}").standard_error == 0);
  CHECK(judged("count(y)", "{from: 5.5, to: 6.5}").verdict == Verdict::holds);
}

TEST_CASE("Missing numbers decide nothing and say why") {
  const auto none = judged("mean(y[bed = c])", "{above: 0}");
  CHECK(none.verdict == Verdict::not_decided);
  CHECK_THAT(none.remark, Catch::Contains("bed = c"));
  auto elsewhere = claim_of("mean(y)", "{above: 0}");
  elsewhere.tables.front().second = "u";
  CHECK_THAT(judge(elsewhere, [](const std::string&) { return nullptr; }).remark,
             Catch::Contains("table u is not there"));
  // Groups without a number are left out, and said to be.
  const auto some = judged("largest(each(x: y[bed = a]))", "{above: 0}");
  CHECK(some.value == 20);
  const auto fewer = judged("largest(each(bed: y[x = 3] / y[x = 1, bed = a]))", "{above: 0}");
  CHECK(fewer.value == 1.5);
  CHECK_THAT(fewer.remark, Catch::Contains("a value of bed is left out"));
}

TEST_CASE("Faults of a claim carry their place") {
  CHECK_THROWS_WITH(claim_of("mean(y)", "{above: 2, below: 1}"), Catch::Contains("x < y"));
  CHECK_THROWS_WITH(claim_of("mean(y)", "{over: 2}"), Catch::Contains("claims.yaml:8:"));
  CHECK_THROWS_WITH(claim_of("mean(", "{above: 2}"), Catch::Contains("claims.yaml:7:10"));
  CHECK_THROWS_WITH(judged("mean(z)", "{above: 2}"), Catch::Contains("c: no table of this claim"));
}

}  // namespace shakebed::fitting::claims
