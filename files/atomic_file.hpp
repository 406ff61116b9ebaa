#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace shakebed::files {

/// A path beside `target` (same folder, so that rename is atomic), unique to this process.
std::filesystem::path temporary_beside(const std::filesystem::path& target);

/// fsync(temporary), rename over `target`, fsync the folder. Nothing partial ever has the final
/// name. Throws Error(failed) with the operating system's reason and removes the temporary.
void publish(const std::filesystem::path& temporary, const std::filesystem::path& target);

/// Writes a whole text file that way, making missing folders.
void write_text(const std::filesystem::path& target, std::string_view text);

/// Reads a whole file; Error(bad_input) with the path and the reason when it cannot.
std::string read_text(const std::filesystem::path& file);

}  // namespace shakebed::files
