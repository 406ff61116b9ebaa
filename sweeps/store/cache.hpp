#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "sweeps/store/run_file.hpp"

namespace shakebed::sweeps::store {

/// What a run is known by: its key and what the key was made of.
struct RunIdentity {
  std::string key;
  std::string canonical_scene;
  int physics_version;
};

/// The folder that keeps finished runs, one file each: FOLDER/ab/abcdef....h5. No locks: files
/// appear at once under their final name and never change, and two processes that compute the
/// same run publish the same data.
class Cache {
 public:
  /// A cache made by another layout is refused with files::Error(bad_input). Nothing is created
  /// until something is stored.
  explicit Cache(std::filesystem::path folder);

  /// The folder asked for, else the environment's SHAKEBED_CACHE, else build/cache.
  static std::filesystem::path place(const std::optional<std::filesystem::path>& asked);

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path file_of(const std::string& key) const;

  struct Found {
    std::optional<RunFile> run;
    std::string problem;  ///< why a file that is there cannot be used and must be made again
  };
  /// Reads the whole file and checks that it holds this very run. A damaged file is a `problem`;
  /// one from another schema throws files::Error(bad_input), because overwriting it would destroy
  /// what another version of shakebed can read.
  Found find(const RunIdentity& run) const;

  void put(const RunIdentity& run, const simulator::Record& record,
           const Provenance& provenance) const;

  /// A run that failed leaves a note, FOLDER/ab/abcdef....failed, until it succeeds.
  void note_failure(const RunIdentity& run, const std::string& message) const;
  std::optional<std::string> failure_of(const std::string& key) const;

 private:
  void claim_folder() const;
  std::filesystem::path folder_;
};

}  // namespace shakebed::sweeps::store
