#include "figures/manifest.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "files/csv.hpp"
#include "tests/figures/one_figure.hpp"
#include "tests/figures/scratch.hpp"

using namespace shakebed;
using Catch::Contains;
using Catch::EndsWith;
namespace fs = std::filesystem;

namespace {

const fs::path source = SHAKEBED_SOURCE_DIR;
const fs::path binary = SHAKEBED_BINARY_DIR;

}  // namespace

TEST_CASE("SHA-256 of known bytes") {
  // FIPS 180-4, example "abc".
  const tests::ScratchFolder folder;
  CHECK(figures::sha256_of(folder.file("abc", "abc")) ==
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST_CASE("shipped files are the ones the manifest vouches for") {
  const auto manifest = figures::read_manifest(source / "data_manifest.yaml");
  std::set<fs::path> vouched;
  for (const auto& file : manifest.files) {
    CAPTURE(file.path);
    CHECK(figures::sha256_of(source / file.path) == file.sha256);
    vouched.insert((source / file.path).lexically_normal());
  }
  if (!fs::exists(source / "data")) return;
  for (const auto& item : fs::recursive_directory_iterator(source / "data")) {
    if (!item.is_regular_file()) continue;
    CAPTURE(item.path());
    CHECK(vouched.contains(item.path().lexically_normal()));
  }
}

TEST_CASE("the manifest has an entry for every declared figure and for no other") {
  std::set<std::string> declared;
  const auto pipeline = files::CsvTable::read(binary / "pipeline.csv");
  for (std::size_t row = 0; row < pipeline.rows(); ++row) declared.insert(pipeline.text(row, 0));
  std::set<std::string> described;
  for (const auto& entry : figures::read_manifest(source / "data_manifest.yaml").entries) {
    described.insert(entry.id);
  }
  CHECK(declared == described);
  CHECK(declared.contains("bhateja2016-fig02"));
}

TEST_CASE("faults of a manifest carry their place") {
  const std::string good = manifest_of_one_figure + R"(
    reference:
      - {name: peak, value: 2, unit: "1", provenance: given, source: Sec. 1, ours: {table: t, row: {x: a}, column: c}, tolerance: {relative: 0.1, why: read off}}
files:
  data/a.csv: {sha256: 0000000000000000000000000000000000000000000000000000000000000000, made_by: nobody}
)";
  struct Case {
    std::string old_text, new_text, place, words;
  };
  const Case cases[] = {
      {"paper: p\n", "paper: q\n", "manifest.yaml:6:12", "'papers'"},
      {"provenance: given", "provenance: guessed", "manifest.yaml:10:55", "not_given"},
      {"value: 2, unit: \"1\", ", "", "manifest.yaml:10:9", "without one"},
      {", ours: {table: t, row: {x: a}, column: c}", "", "manifest.yaml:10:9", "belong together"},
      {"relative: 0.1", "relative: -0.1", "manifest.yaml:10:142", "positive"},
      {"sha256: 0000", "sha256: 000", "manifest.yaml:12:24", "64"},
      {"what:", "wat:", "manifest.yaml:8:5", "what"},
  };
  const tests::ScratchFolder folder;
  CHECK(figures::read_manifest(folder.file("manifest.yaml", good)).entry("p-fig1").item ==
        "Fig. 1");
  for (const auto& [old_text, new_text, place, words] : cases) {
    auto text = good;
    REQUIRE(text.find(old_text) != std::string::npos);
    text.replace(text.find(old_text), old_text.size(), new_text);
    const auto file = folder.file("manifest.yaml", text);
    const auto fault = tests::fault_of([&file] { figures::read_manifest(file); });
    CAPTURE(new_text);
    CHECK_THAT(fault.where, EndsWith(place));
    CHECK_THAT(fault.what, Contains(words));
  }
}
