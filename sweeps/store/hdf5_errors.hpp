#pragma once

#include <hdf5.h>

#include <string>

#include "sweeps/store/hdf5.hpp"

namespace shakebed::sweeps::store::hdf5 {

/// Throws files::Error(failed): `what`, and the reason that HDF5 gives.
[[noreturn]] void fail(const std::string& where, const std::string& what);

/// The identifier, or fail().
hid_t checked(hid_t id, const std::string& where, const char* what);
void check(herr_t status, const std::string& where, const char* what);

/// Creation properties of a group or file that keep the order of names and no times, which would
/// make equal results differ.
Handle group_creation(hid_t property_class);

}  // namespace shakebed::sweeps::store::hdf5
