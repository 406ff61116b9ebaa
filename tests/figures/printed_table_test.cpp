#include "figures/printed_table.hpp"

#include <catch2/catch.hpp>

using namespace shakebed;

namespace {

figures::Specification one_part() {
  figures::Specification specification;
  specification.title = "A table";
  specification.notes = {"A note."};
  figures::Part part;
  part.title = "Parameters";
  part.columns = {{figures::CopiedColumn{"system", "system", std::nullopt}, ""},
                  {figures::CopiedColumn{"value", "ours", 3}, ""},
                  {figures::CopiedColumn{"difference", "difference", 2}, ""}};
  specification.parts = {part};
  return specification;
}

files::CsvTable numbers() {
  files::CsvTable table({{"system", ""}, {"ours", "m V_p^2"}, {"difference", "%"}});
  table.add_row({"3D rough", "0.0540123", "-181.7"});
  table.add_row({"2D", "12", ""});
  return table;
}

}  // namespace

TEST_CASE("a printed table rounds, aligns and says what is missing") {
  CHECK(figures::as_text(one_part(), {numbers()}) == R"(
A table

Parameters
  system    ours [m V_p^2]  difference [%]
  ----------------------------------------
  3D rough          0.0540            -182
  2D                  12.0               -

A note.
)");
}

TEST_CASE("the same table as Markdown") {
  CHECK(figures::as_markdown(one_part(), {numbers()}) == R"(# A table

Parameters

| system | ours [m V_p^2] | difference [%] |
|---|---:|---:|
| 3D rough | 0.0540 | -182 |
| 2D | 12.0 | - |

A note.
)");
}
