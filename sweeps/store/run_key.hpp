#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace shakebed::sweeps::store {

/// 32 hexadecimal digits (XXH128) of everything a run's data depend on: the canonical scene (the
/// seed is part of it), the run file's schema and the physics version. Two runs of a key have
/// the same data; whatever changes numbers changes the key.
std::string run_key(std::string_view canonical_scene, int physics_version, std::uint64_t seed);

/// XXH128 of any text as 32 hexadecimal digits, the same on every machine.
std::string digest(std::string_view text);

/// XXH3-64 of any text, the same on every machine.
std::uint64_t hash(std::string_view text);

}  // namespace shakebed::sweeps::store
