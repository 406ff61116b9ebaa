#include "files/yaml.hpp"

#include <catch2/catch.hpp>

#include "tests/figures/scratch.hpp"

namespace {

using namespace shakebed;
using files::YamlNode;

YamlNode load(const std::string& text) { return YamlNode::load_text(text, "s.yaml"); }

TEST_CASE("A tree knows its kinds, places, paths and order") {
  const YamlNode root = load(
      "# comment\n"
      "b: 1\n"
      "a:\n"
      "  - x\n"
      "  - {c: 2, d: [3, 4]}\n"
      "empty:\n");
  CHECK(root.where() == "s.yaml:2:1");
  CHECK(root.items()[0].first == "b");
  CHECK(root.items()[1].first == "a");
  const YamlNode list = root.at("a");
  CHECK(list.where() == "s.yaml:4:3");
  CHECK(list.elements()[0].where() == "s.yaml:4:5");
  const YamlNode d = list.elements()[1].at("d");
  CHECK(d.path() == "a[1].d");
  CHECK(d.where() == "s.yaml:5:15");
  CHECK(d.elements()[1].as_integer() == 4);
  CHECK(root.key_where("a") == "s.yaml:3:1");
  CHECK(root.at("empty").kind() == YamlNode::Kind::null);
  CHECK(root.at("empty").where() == "s.yaml:6:1");
  CHECK_FALSE(root.find("c"));
}

TEST_CASE("Empty files are empty trees") {
  for (const char* text : {"", "\n", "# comment\n", "---\n", "~"}) {
    CAPTURE(text);
    CHECK(load(text).kind() == YamlNode::Kind::null);
  }
}

TEST_CASE("Numbers are read in every decimal spelling and in no other") {
  const YamlNode root = load(
      "{one: 1, tenth: .1, thousand: 1e3, plus: +5, minus: -2.5e-3, denormal: 4.9e-324, "
      "seed: 9223372036854775807, big: 9007199254740993}");
  CHECK(root.at("one").as_double() == 1);
  CHECK(root.at("tenth").as_double() == 0.1);
  CHECK(root.at("thousand").as_integer() == 1000);
  CHECK(root.at("plus").as_integer() == 5);
  CHECK(root.at("minus").as_double() == -0.0025);
  CHECK(root.at("denormal").as_double() == 4.9e-324);
  CHECK(root.at("seed").as_integer() == 9223372036854775807);
  CHECK(root.at("big").as_integer() == 9007199254740993);

  for (const char* text : {"010", "-010", "1e999", ".nan", "nan", ".inf", "inf", "0x10", "1_000",
                           "one", "\"1\"", "[1]", "{a: 1}", "", "true", "1 d"}) {
    CAPTURE(text);
    const YamlNode value = load(std::string("x: ") + text).at("x");
    CHECK_THROWS_AS(value.as_double(), files::Error);
    CHECK_THROWS_AS(value.as_integer(), files::Error);
  }
  for (const char* text : {"1.5", "1e-3", "1e16", "9223372036854775808"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(load(text).as_integer(), files::Error);
  }
}

TEST_CASE("Only true and false are truth values") {
  CHECK(load("true").as_bool());
  CHECK_FALSE(load("false").as_bool());
  for (const char* text : {"yes", "on", "1", "True", "\"true\""}) {
    CAPTURE(text);
    CHECK_THROWS_AS(load(text).as_bool(), files::Error);
  }
}

TEST_CASE("What yaml-cpp lets pass is refused with its place") {
  struct Case {
    std::string text, where, what;
  };
  const Case cases[] = {
      {"a: 1\nb: 2\na: 3\n", "s.yaml:3:1", "key `a` was already given at s.yaml:1:1"},
      {"g: {x: 1, x: 2}\n", "s.yaml:1:11", "key `x` was already given"},
      {"a: {b: 1}\nc:\n  <<: 1\n", "s.yaml:3:3", "merge keys"},
      {"a: &name 1\n", "s.yaml:1:4", "anchors"},
      {"a: !!str 1\n", "s.yaml:1:4", "tags"},
      {"a: 1\n---\nb: 2\n", "s.yaml:2:1", "second document"},
      {", a: 1\n", "s.yaml:1:1", "stray character"},
      {"a: [1, 2\n", "s.yaml:2:1", "not valid YAML"},
      {"a: 1\n\tb: 2\n", "s.yaml:2:1", "not valid YAML"},
      {"? [1]\n: 2\n", "s.yaml:1:3", "a key must be a word"},
      {"a: *name\n", "s.yaml:1:4", "not valid YAML"},
  };
  for (const auto& one : cases) {
    CAPTURE(one.text);
    const auto fault = tests::fault_of([&] { load(one.text); });
    CHECK(fault.where == one.where);
    CHECK_THAT(fault.what, Catch::Contains(one.what));
  }
}

TEST_CASE("Faults of structure come all at once, or to a reader that collects") {
  const std::string text = "a: 1\na: 2\nb: &x 3\n";
  try {
    load(text);
    FAIL("must throw");
  } catch (const files::Error& error) {
    CHECK(error.faults().size() == 2);
    CHECK(error.kind() == files::Error::Kind::bad_input);
  }
  std::vector<files::Fault> faults;
  CHECK(YamlNode::load_text(text, "s.yaml", faults).at("a").as_integer() == 1);
  CHECK(faults.size() == 2);
}

TEST_CASE("Wrong types and missing keys name the path, the place and what was found") {
  const YamlNode root = load("base:\n  drive: {W: fast}\n");
  const auto fault = tests::fault_of([&] { root.at("base").at("drive").at("W").as_double(); });
  CHECK(fault.where == "s.yaml:2:14");
  CHECK(fault.what == "`base.drive.W`: expected a finite number, got `fast`");
  const auto missing = tests::fault_of([&] { root.at("base").at("drive").at("amplitude"); });
  CHECK(missing.where == "s.yaml:2:10");
  CHECK(missing.what == "the key `base.drive.amplitude` is missing");
  CHECK_THAT(tests::fault_of([&] { root.at("base").elements(); }).what,
             Catch::Contains("expected a list [...], got a map"));
  CHECK_THAT(tests::fault_of([&] { root.at("base").as_string(); }).what,
             Catch::Contains("expected a word, got a map"));
}

TEST_CASE("Unknown keys are refused at their own place, with the nearest known one") {
  const YamlNode root = load("fit: 1\nmodle: power_law\nzzz: 3\n");
  try {
    root.refuse_unknown_keys({"fit", "model", "data"});
    FAIL("must throw");
  } catch (const files::Error& error) {
    REQUIRE(error.faults().size() == 2);
    CHECK(error.faults()[0].where == "s.yaml:2:1");
    CHECK(error.faults()[0].what == "unknown key `modle`; did you mean `model`?");
    CHECK(error.faults()[1].what == "unknown key `zzz`; known here: fit model data");
  }
  CHECK_NOTHROW(root.refuse_unknown_keys({"fit", "modle", "zzz"}));
}

TEST_CASE("A missing file is named") {
  CHECK(tests::fault_of([] { YamlNode::load_file("nowhere/scene.yaml"); }).where ==
        "nowhere/scene.yaml");
}

}  // namespace
