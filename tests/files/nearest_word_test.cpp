#include <catch2/catch.hpp>

#include "files/yaml.hpp"

namespace {

using shakebed::files::nearest_word;

TEST_CASE("The nearest word is found when it is near enough to help") {
  const std::vector<std::string> known{"friction", "restitution", "layers", "run", "W", "Gamma"};
  CHECK(nearest_word("friktion", known) == "friction");
  CHECK(nearest_word("Friction", known) == "friction");
  CHECK(nearest_word("restituion", known) == "restitution");
  CHECK(nearest_word("layesr", known) == "layers");
  CHECK(nearest_word("rnu", known) == "run");
  CHECK(nearest_word("w", known) == "W");
  CHECK_FALSE(nearest_word("mu", known));
  CHECK_FALSE(nearest_word("cohesion_of_wet_grains", known));
  CHECK_FALSE(nearest_word("", known));
  CHECK_FALSE(nearest_word(std::string(100000, 'x'), known));
}

}  // namespace
