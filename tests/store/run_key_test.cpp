#include "sweeps/store/run_key.hpp"

#include <catch2/catch.hpp>

namespace shakebed::tests {
namespace {

using sweeps::store::digest;
using sweeps::store::run_key;

TEST_CASE("Whatever changes numbers changes the key") {
  const std::string scene = "scene: 1\nseed: 1\n";
  const std::string key = run_key(scene, 1, 1);
  CHECK(key.size() == 32);
  CHECK(key.find_first_not_of("0123456789abcdef") == std::string::npos);
  CHECK(run_key(scene, 1, 1) == key);
  CHECK(run_key(scene + " ", 1, 1) != key);
  CHECK(run_key(scene, 2, 1) != key);
  CHECK(run_key(scene, 1, 2) != key);
  CHECK(run_key("seed 1\n" + scene, 1, 1) != key);
}

TEST_CASE("Digests are XXH128 and do not change between machines or versions") {
  // xxhash 0.8 specification: XXH3_128bits of the empty text, seed 0, is
  // 0x99aa06d3014798d8 6001c324468d497f. `printf "" | xxh128sum` prints the same.
  CHECK(digest("") == "99aa06d3014798d86001c324468d497f");
}

}  // namespace
}  // namespace shakebed::tests
