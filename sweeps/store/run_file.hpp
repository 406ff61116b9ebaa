#pragma once

#include <filesystem>
#include <string>

#include "simulator/record.hpp"

namespace shakebed::sweeps::store {

/// Raised when the layout of run files changes so that older readers would go wrong.
inline constexpr int run_file_schema = 1;

/// What made a result. None of it is part of a run's key.
struct Provenance {
  std::string shakebed_version;
  std::string git_revision;
  std::string compiler;
  std::string compiler_flags;
  std::string machine;  ///< what -march came to
  std::string preset;   ///< the CMake preset
  std::string cpu;      ///< model name of the processor that ran it
};

/// Of the running program, on this machine.
Provenance provenance_of_this_program();

struct RunFile {
  simulator::Record record;
  Provenance provenance;
};

/// Writes one run as HDF5: the whole file is built in memory, then published at once, so that a
/// full disk or a kill leaves no file of that name. Groups:
///   /scene/canonical_yaml       the scene as understood
///   /averages/NAME              {mean, standard_error}, attribute `unit`
///   /scalars/NAME               a number, attribute `unit`
///   /series/NAME                attributes `unit`, `cycles_per_entry`
///   /profiles/z, /profiles/NAME {mean, standard_error} of each box; attribute `box_depth`
///   /snapshots/NAME/{id, position, velocity, spin, radius}   one row a grain; when asked for
///   /contacts/NAME/{i, j, normal_force}                      j = -1: a wall
///   /verdict                    attributes `stationary`, `stationary_reason`, `at_rest`; warnings
///   /provenance                 attributes: physics version, revision, compiler, seed, ...
///   /timing                     attributes; the only thing that differs from run to run
/// Data sets are chunked and carry a Fletcher-32 checksum; metadata has HDF5's own checksums.
/// Throws files::Error(failed) when the folder cannot be written.
void write_run_file(const std::filesystem::path& file, const simulator::Record& record,
                    const Provenance& provenance);

/// Reads it back bit for bit. Throws files::Error(failed) naming the file and data set when it is
/// truncated or corrupt, and files::Error(bad_input) when it is something else than a run file or
/// has another schema.
RunFile read_run_file(const std::filesystem::path& file);

}  // namespace shakebed::sweeps::store
