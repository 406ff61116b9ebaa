#include "figures/specification.hpp"

#include <catch2/catch.hpp>

#include "tests/figures/scratch.hpp"

using namespace shakebed;
using Catch::Contains;
using Catch::EndsWith;

namespace {

const std::string good = R"(figure: 1
id: fig
title: A figure
script: fig.gp
size: [800, 600]
parts:
  points:
    from: [one, two]
    where: {system: [2D rough, 3D rough]}
    columns:
      - W
      - {column: T_z, as: temperature}
      - state: {stationary: stationary, at_rest: at_rest}
  studies:
    file: studies.csv
)";

std::string with(const std::string& old_text, const std::string& new_text) {
  auto text = good;
  const auto place = text.find(old_text);
  REQUIRE(place != std::string::npos);
  return text.replace(place, old_text.size(), new_text);
}

files::Fault fault_in(const std::string& text) {
  const tests::ScratchFolder folder;
  const auto file = folder.file("fig.yaml", text);
  return tests::fault_of([&file] { figures::read_specification(file); });
}

}  // namespace

TEST_CASE("a specification names its parts, columns and tables") {
  const tests::ScratchFolder folder;
  const auto specification = figures::read_specification(folder.file("fig.yaml", good));
  CHECK(specification.id == "fig");
  CHECK(specification.script == folder.path() / "fig.gp");
  CHECK(specification.table_names() == std::vector<std::string>{"one", "two"});
  REQUIRE(specification.parts.size() == 2);
  const auto& points = specification.parts.front();
  REQUIRE(points.columns.size() == 3);
  CHECK(std::get<figures::CopiedColumn>(points.columns[1].kind).as == "temperature");
  CHECK(std::get<figures::StateColumn>(points.columns[2].kind).as == "state");
  CHECK(points.filters.front().words == std::vector<std::string>{"2D rough", "3D rough"});
  const auto& studies = std::get<figures::TableFile>(specification.parts.back().source);
  CHECK(studies.file == folder.path() / "studies.csv");
}

TEST_CASE("faults of a specification carry their place") {
  struct Case {
    std::string text;
    std::string place;
    std::string words;
  };
  const Case cases[] = {
      {with("figure: 1", "figure: 2"), "fig.yaml:1:9", "schema 1"},
      {with("title:", "titel:"), "fig.yaml:3:1", "title"},
      {with("script: fig.gp\n", ""), "fig.yaml:1:1", "'size' belongs to a picture"},
      {with("[800, 600]", "[800, 6]"), "fig.yaml:5:13", "pixels"},
      {with("    from: [one, two]\n", ""), "fig.yaml:8:5", "exactly one of"},
      {with("as: temperature", "as: 2T"), "fig.yaml:12:9", "letter"},
      {with("at_rest: at_rest", "at_rst: at_rest"), "fig.yaml:13:41", "at_rest"},
      {with("  points:", "  po-ints:"), "fig.yaml:8:5", "letters"},
  };
  for (const auto& [text, place, words] : cases) {
    CAPTURE(text);
    const auto fault = fault_in(text);
    CHECK_THAT(fault.where, EndsWith(place));
    CHECK_THAT(fault.what, Contains(words));
  }
}
