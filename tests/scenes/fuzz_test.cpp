#include <catch2/catch.hpp>
#include <filesystem>
#include <random>

#include "files/atomic_file.hpp"
#include "simulator/contact/parameters.hpp"
#include "tests/scenes/texts.hpp"

// Scenes damaged at random are read or refused by files::Error; nothing else may come out of the
// reader. The seeds are fixed, so a failure repeats.
namespace {

using namespace shakebed;

const std::vector<std::string> fragments{"0",
                                         "-1",
                                         "1e999",
                                         ".nan",
                                         "010",
                                         "null",
                                         "~",
                                         "true",
                                         "auto",
                                         "[",
                                         "]",
                                         "{",
                                         "}",
                                         ":",
                                         ": ",
                                         "- ",
                                         "\n",
                                         "  ",
                                         "\t",
                                         "#",
                                         "\"",
                                         "'",
                                         "<<: ",
                                         "&a ",
                                         "*a",
                                         "!!str ",
                                         "---\n",
                                         "...\n",
                                         "%YAML 9.9\n",
                                         "? ",
                                         "|\n",
                                         ">",
                                         "\\x",
                                         "\xff",
                                         "\xc3",
                                         "1 %",
                                         "5 mm",
                                         "W: 3\n",
                                         "cell",
                                         "cycles: 1e3",
                                         "T_z: 1 %",
                                         "drive",
                                         "\"\\U99999999\"",
                                         "@",
                                         "`",
                                         ",",
                                         "\r",
                                         "9223372036854775808",
                                         "1e-400"};

std::string damaged(std::string text, std::mt19937_64& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % (n + 1)); };
  const std::size_t times = 1 + below(3);
  for (std::size_t i = 0; i < times; ++i) {
    const std::size_t at = below(text.size());
    const std::size_t length = std::min(text.size() - at, below(8));
    switch (random() % 5) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(at, fragments[random() % fragments.size()]);
        break;
      case 2:
        text.replace(at, length, fragments[random() % fragments.size()]);
        break;
      case 3:
        text.insert(at, text.substr(below(text.size()), below(40)));
        break;
      default:
        if (at < text.size()) text[at] = static_cast<char>(random() & 0xff);
    }
  }
  return text;
}

/// Reads, and when there is nothing to complain about, goes on to what a run would do first.
bool accepted(const std::string& text, const std::vector<simulator::Override>& overrides) {
  try {
    const auto scene = tests::scene_of(text, overrides);
    const auto parameters = simulator::bind_parameters(scene);
    const std::string canonical = simulator::canonical_yaml(scene);
    return parameters.time_step > 0 && parameters.steps_per_cycle > 0 &&
           simulator::canonical_yaml(tests::scene_of(canonical)) == canonical;
  } catch (const files::Error& error) {
    for (const auto& fault : error.faults()) {
      if (fault.where.empty() || fault.what.empty()) {
        throw std::logic_error("a fault without place or words: " + fault.where + fault.what);
      }
    }
    return false;
  }
}

TEST_CASE("Damaged scenes are read or refused, and never worse") {
  const std::filesystem::path folder = std::filesystem::path(SHAKEBED_SOURCE_FOLDER) / "scenes";
  const std::vector<std::string> originals{
      tests::rough_bed, files::read_text(folder / "rough_3d.yaml"),
      files::read_text(folder / "smooth_2d.yaml"),
      simulator::canonical_yaml(tests::scene_of(tests::rough_bed))};
  std::mt19937_64 random(20261122);
  int read = 0;
  int refused = 0;
  for (int round = 0; round < 10000; ++round) {
    const std::string text = damaged(originals[random() % originals.size()], random);
    CAPTURE(round, text);
    bool fine = false;
    REQUIRE_NOTHROW(fine = accepted(text, {}));
    ++(fine ? read : refused);
  }
  // Both ways through the reader are tried often, or this test would show nothing.
  CHECK(read > 500);
  CHECK(refused > 2500);
}

TEST_CASE("Settings of random keys and values are read or refused") {
  const std::vector<std::string> paths{"base.drive.W",
                                       "base.drive.frequency_rpm",
                                       "base.drive",
                                       "base",
                                       "cell",
                                       "cell.0",
                                       "grains",
                                       "grains.count",
                                       "seed",
                                       "scene",
                                       "dimension",
                                       "protocol",
                                       "protocol.measure.until.T",
                                       "protocol.measure.until",
                                       "contact.tangential",
                                       "contact.tangential.damping",
                                       "units.diameter",
                                       "",
                                       ".",
                                       "a..b",
                                       "grains.friction.x"};
  std::mt19937_64 random(5);
  for (int round = 0; round < 3000; ++round) {
    std::vector<simulator::Override> overrides;
    for (std::size_t i = 0; i <= random() % 3; ++i) {
      std::string value = fragments[random() % fragments.size()];
      if (random() % 3 == 0) value = std::to_string(random() % 100);
      if (random() % 4 == 0) value += fragments[random() % fragments.size()];
      overrides.push_back({paths[random() % paths.size()], value});
    }
    CAPTURE(round);
    REQUIRE_NOTHROW(accepted(tests::rough_bed, overrides));
  }
}

TEST_CASE("Nesting without end is refused, not followed") {
  for (const char* bracket : {"[", "{a: ", "- ", "? "}) {
    std::string text;
    for (int depth = 0; depth < 20000; ++depth) text += bracket;
    CAPTURE(bracket);
    CHECK_FALSE(accepted(text, {}));
  }
}

}  // namespace
