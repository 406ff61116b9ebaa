#pragma once

#include <filesystem>

#include "simulator/bed_store.hpp"

namespace shakebed::sweeps::store {

/// Prepared beds and checkpoints as files FOLDER/beds/DIGEST.bed, named by a digest of what they
/// are called. A file that is damaged, or holds something else, counts as absent: it is made again.
simulator::BedStore bed_store(const std::filesystem::path& folder);

}  // namespace shakebed::sweeps::store
