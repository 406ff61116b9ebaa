#include "sweeps/store/run_key.hpp"

#include <xxhash.h>

#include "sweeps/store/run_file.hpp"

namespace shakebed::sweeps::store {

std::string digest(std::string_view text) {
  const XXH128_hash_t value = XXH3_128bits(text.data(), text.size());
  XXH128_canonical_t bytes;
  XXH128_canonicalFromHash(&bytes, value);
  constexpr std::string_view digits = "0123456789abcdef";
  std::string hex;
  for (const unsigned char byte : bytes.digest) {
    hex += digits[byte >> 4];
    hex += digits[byte & 15];
  }
  return hex;
}

std::uint64_t hash(std::string_view text) { return XXH3_64bits(text.data(), text.size()); }

std::string run_key(std::string_view canonical_scene, int physics_version, std::uint64_t seed) {
  // The scene comes last, so that no scene can imitate the lines before it.
  std::string text = "run file schema " + std::to_string(run_file_schema) + "\nphysics version " +
                     std::to_string(physics_version) + "\nseed " + std::to_string(seed) + "\n";
  text += canonical_scene;
  return digest(text);
}

}  // namespace shakebed::sweeps::store
