#include "sweeps/store/bed_store.hpp"

#include <system_error>

#include "files/atomic_file.hpp"
#include "files/error.hpp"
#include "sweeps/store/run_key.hpp"

namespace shakebed::sweeps::store {
namespace {

namespace fs = std::filesystem;

/// What comes before the bytes: their digest and the name, each with its length or a fixed one.
std::string head_of(const std::string& name, const std::string& bytes) {
  return "shakebed bed 1\n" + digest(bytes) + "\n" + std::to_string(name.size()) + "\n" + name +
         "\n";
}

fs::path file_of(const fs::path& folder, const std::string& name) {
  return folder / "beds" / (digest(name) + ".bed");
}

std::optional<std::string> load(const fs::path& folder, const std::string& name) {
  const fs::path file = file_of(folder, name);
  if (!fs::exists(file)) return std::nullopt;
  const std::string text = files::read_text(file);
  const std::size_t length = head_of(name, "").size();
  if (text.size() < length) return std::nullopt;
  std::string bytes = text.substr(length);
  if (text.substr(0, length) != head_of(name, bytes)) return std::nullopt;
  return bytes;
}

void save(const fs::path& folder, const std::string& name, const std::string& bytes) {
  const fs::path file = file_of(folder, name);
  std::error_code problem;
  fs::create_directories(file.parent_path(), problem);
  if (problem) {
    throw files::failed(file.parent_path().string(), "cannot be made: " + problem.message());
  }
  files::write_text(file, head_of(name, bytes) + bytes);
}

}  // namespace

simulator::BedStore bed_store(const fs::path& folder) {
  return {
      [folder](const std::string& name) { return load(folder, name); },
      [folder](const std::string& name, const std::string& bytes) { save(folder, name, bytes); },
      [folder](const std::string& name) {
        std::error_code ignored;
        fs::remove(file_of(folder, name), ignored);
      }};
}

}  // namespace shakebed::sweeps::store
