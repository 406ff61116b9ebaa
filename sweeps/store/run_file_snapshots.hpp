#pragma once

#include <vector>

#include "simulator/record.hpp"
#include "sweeps/store/hdf5.hpp"

namespace shakebed::sweeps::store {

/// /snapshots/NAME and /contacts/NAME of a run file, as `shakebed network` reads them. A run
/// without snapshots has neither group.
void write_snapshots(const hdf5::Group& root, const std::vector<simulator::Snapshot>& snapshots);

/// Throws files::Error(failed) where lists that belong together differ in length.
std::vector<simulator::Snapshot> read_snapshots(const hdf5::Group& root);

}  // namespace shakebed::sweeps::store
