#pragma once

#include <string>

namespace shakebed::cli {

/// JSON schema (draft 07) of scenes, made from the table of keys: types, words, ranges and which
/// keys exist. Editors complete and check with it; what only fits together (two drive keys, whole
/// grain counts) is checked by the reader alone.
std::string scene_json_schema();

}  // namespace shakebed::cli
