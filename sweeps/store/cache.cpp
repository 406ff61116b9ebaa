#include "sweeps/store/cache.hpp"

#include <cstdlib>

#include "files/atomic_file.hpp"
#include "files/error.hpp"

namespace shakebed::sweeps::store {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view layout_line = "shakebed cache, layout 1\n";

fs::path layout_file(const fs::path& folder) { return folder / "LAYOUT"; }

std::optional<std::string> mismatch(const RunFile& run, const RunIdentity& wanted) {
  if (run.record.canonical_scene != wanted.canonical_scene) return "holds another scene";
  if (run.record.physics_version != wanted.physics_version) return "has another physics version";
  return std::nullopt;
}

}  // namespace

Cache::Cache(fs::path folder) : folder_(std::move(folder)) {
  if (fs::exists(folder_) && !fs::is_directory(folder_)) {
    throw files::bad_input(folder_.string(), "is not a folder; a cache must be one");
  }
  if (!fs::exists(layout_file(folder_))) return;
  const std::string found = files::read_text(layout_file(folder_));
  if (found != layout_line) {
    throw files::bad_input(layout_file(folder_).string(),
                           "cache from another schema: expected \"" +
                               std::string(layout_line.substr(0, layout_line.size() - 1)) +
                               "\", got \"" + found.substr(0, found.find('\n')) +
                               "\"; use another --cache");
  }
}

fs::path Cache::place(const std::optional<fs::path>& asked) {
  if (asked) return *asked;
  const char* environment = std::getenv("SHAKEBED_CACHE");
  if (environment != nullptr && *environment != '\0') return environment;
  return fs::path("build") / "cache";
}

fs::path Cache::file_of(const std::string& key) const {
  return folder_ / key.substr(0, 2) / (key + ".h5");
}

Cache::Found Cache::find(const RunIdentity& run) const {
  const fs::path file = file_of(run.key);
  if (!fs::exists(file)) return {};
  try {
    RunFile found = read_run_file(file);
    if (const auto fault = mismatch(found, run)) {
      return {std::nullopt, file.string() + ": " + *fault};
    }
    return {std::move(found), {}};
  } catch (const files::Error& error) {
    if (error.kind() == files::Error::Kind::bad_input) throw;
    return {std::nullopt, error.what()};
  }
}

void Cache::put(const RunIdentity& run, const simulator::Record& record,
                const Provenance& provenance) const {
  claim_folder();
  write_run_file(file_of(run.key), record, provenance);
  std::error_code ignored;
  fs::remove(file_of(run.key).replace_extension(".failed"), ignored);
}

void Cache::note_failure(const RunIdentity& run, const std::string& message) const {
  claim_folder();
  files::write_text(file_of(run.key).replace_extension(".failed"),
                    message + "\n---\n" + run.canonical_scene);
}

std::optional<std::string> Cache::failure_of(const std::string& key) const {
  const fs::path note = file_of(key).replace_extension(".failed");
  if (!fs::exists(note)) return std::nullopt;
  const std::string text = files::read_text(note);
  return text.substr(0, text.find("\n---\n"));
}

void Cache::claim_folder() const {
  if (!fs::exists(layout_file(folder_))) files::write_text(layout_file(folder_), layout_line);
}

}  // namespace shakebed::sweeps::store
