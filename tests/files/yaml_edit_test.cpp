#include <catch2/catch.hpp>
#include <random>

#include "files/yaml.hpp"
#include "tests/figures/scratch.hpp"

namespace {

using namespace shakebed;
using files::YamlNode;
using Kind = YamlNode::Kind;

YamlNode load(const std::string& text) { return YamlNode::load_text(text, "s.yaml"); }

void check_same(const YamlNode& a, const YamlNode& b) {
  REQUIRE(a.kind() == b.kind());
  if (a.is_scalar()) REQUIRE(a.as_string() == b.as_string());
  if (a.is_map()) {
    REQUIRE(a.items().size() == b.items().size());
    for (std::size_t i = 0; i < a.items().size(); ++i) {
      REQUIRE(a.items()[i].first == b.items()[i].first);
      check_same(a.items()[i].second, b.items()[i].second);
    }
  }
  if (a.is_sequence()) {
    REQUIRE(a.elements().size() == b.elements().size());
    for (std::size_t i = 0; i < a.elements().size(); ++i) {
      check_same(a.elements()[i], b.elements()[i]);
    }
  }
}

TEST_CASE("Setting a key changes it alone and gives it the origin as its place") {
  const YamlNode root = load("a: {b: 1, c: 2}\nd: 3\n");
  const YamlNode edited = root.with("a.b", "[7, {x: 8}]", "--set a.b");
  CHECK(root.at("a").at("b").as_integer() == 1);
  const YamlNode b = edited.at("a").at("b");
  CHECK(b.elements()[1].at("x").as_integer() == 8);
  CHECK(b.elements()[1].at("x").path() == "a.b[1].x");
  CHECK(b.elements()[1].at("x").where() == "--set a.b");
  CHECK(edited.at("a").key_where("b") == "--set a.b");
  CHECK(edited.at("a").at("c").where() == "s.yaml:1:14");
  CHECK(edited.items()[0].first == "a");
}

TEST_CASE("Setting makes the maps on its way, also in place of a word or nothing") {
  const YamlNode root = load("transient: auto\nempty:\nlist: [1]\n");
  CHECK(root.with("transient.cycles", "5", "o").at("transient").at("cycles").as_integer() == 5);
  CHECK(root.with("empty.x.y", "5", "o").at("empty").at("x").at("y").path() == "empty.x.y");
  const auto fault = tests::fault_of([&] { root.with("list.0", "5", "--set list.0=5"); });
  CHECK(fault.where == "--set list.0=5");
  CHECK_THAT(fault.what, Catch::Contains("is a list; set it as a whole"));
}

TEST_CASE("A path or a value that makes no sense is refused at its origin") {
  const YamlNode root = load("a: 1\n");
  for (const char* path : {"", ".a", "a.", "a..b"}) {
    CAPTURE(path);
    CHECK(tests::fault_of([&] { root.with(path, "1", "o"); }).where == "o");
  }
  for (const char* value : {"[1", "{x: 1, x: 2}", "*alias", "a: b: c"}) {
    CAPTURE(value);
    CHECK(tests::fault_of([&] { root.with("a", value, "o"); }).where == "o");
  }
}

TEST_CASE("Removing a key removes it alone") {
  const YamlNode root = load("a: {b: 1, c: 2}\n");
  CHECK_FALSE(root.without("a.b").at("a").has("b"));
  CHECK(root.without("a.b").at("a").has("c"));
  check_same(root.without("a.x.y"), root);
  check_same(root.without("x"), root);
}

TEST_CASE("Text of a tree reads back as the same tree with the same types") {
  const YamlNode root = load(
      "\"2D smooth\": {grains.count: 40, cell: [10], empty: {}, none: [], nothing: }\n"
      "words: [a b, \"10\", '', \"a\\nb\", 'it''s', \"true\", \"~\", ': ', -x, 1 %, \"\\x01\"]\n"
      "block: |\n  two\n  lines\n");
  const std::string text = root.to_text();
  const YamlNode back = load(text);
  check_same(root, back);
  CHECK(back.to_text() == text);
  CHECK(back.at("2D smooth").at("grains.count").as_integer() == 40);
  CHECK_THROWS_AS(back.at("words").elements()[1].as_integer(), files::Error);
}

TEST_CASE("Trees of any words survive being written") {
  std::mt19937_64 random(11);
  const std::string alphabet = "ab 1-:#,[]{}\"'%&*!|>@`~\n\t\\.\xc3\xa9";
  const auto word = [&] {
    std::string text;
    const auto length = random() % 5;
    while (text.size() < length) {
      const char c = alphabet[random() % (alphabet.size() - 2)];
      text += c;
    }
    return text;
  };
  const auto quoted = [](const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
      if (c == '"' || c == '\\') out += '\\';
      if (c == '\n') {
        out += "\\n";
      } else if (c == '\t') {
        out += "\\t";
      } else {
        out += c;
      }
    }
    return out + "\"";
  };
  for (int round = 0; round < 500; ++round) {
    const std::string key = word();
    if (key == "<<") continue;
    const YamlNode root =
        load("{" + quoted("k" + key) + ": [" + quoted(word()) + ", {x: " + quoted(word()) + "}]}");
    check_same(root, load(root.to_text()));
  }
}

}  // namespace
