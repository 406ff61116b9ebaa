#include "tests/architecture/rules.hpp"

namespace shakebed::tests {

const std::vector<Room>& rooms() {
  // Headers with nothing to link, which rooms that must not link the simulator share with it.
  static const std::string record = "simulator/record.hpp";
  static const std::string scene = "simulator/scene/scene.hpp";
  static const std::string beds = "simulator/bed_store.hpp";
  // Not the cache, and not HDF5 itself: a fit reads what is collected and writes no run; networks
  // read snapshots through the store's layer.
  static const std::string store_reading = "sweeps/store/run_file.hpp";
  static const std::string store_snapshots = "sweeps/store/hdf5.hpp";
  static const std::vector<Room> table = {
      {.folder = "files/", .ours = {"files/"}, .packages = {"yaml-cpp/"}, .posix = true},
      {.folder = "simulator/",
       .ours = {"files/", "simulator/"},
       .packages = {"Eigen/", "Random123/", "experimental/simd"},
       .posix = true},
      {.folder = "sweeps/store/",
       .ours = {"files/", "sweeps/store/", record, scene, beds},
       .packages = {"hdf5.h", "xxhash.h"},
       .posix = true},
      {.folder = "sweeps/",
       .ours = {"files/", "simulator/", "sweeps/"},
       .packages = {"tbb/", "boost/math/"},
       .posix = true},
      {.folder = "fitting/",
       .ours = {"files/", "fitting/", store_reading, record},
       .packages = {"gsl/", "Eigen/"},
       .posix = false},
      {.folder = "fitting/networks/",
       .ours = {"files/", "fitting/", store_reading, store_snapshots, record},
       .packages = {"gsl/", "Eigen/", "boost/", "nanoflann.hpp"},
       .posix = false},
      {.folder = "figures/",
       .ours = {"files/", "fitting/", "figures/"},
       .packages = {"openssl/"},
       .posix = true},
      {.folder = "cli/",
       .ours = {"files/", "simulator/", "sweeps/", "fitting/", "figures/", "cli/"},
       .packages = {"CLI/", "nlohmann/"},
       .posix = true},
      {.folder = "tests/", .ours = {""}, .packages = {""}, .posix = true},
      {.folder = "bench/",
       .ours = {"files/", "simulator/", "sweeps/", "fitting/", "bench/", "tests/"},
       .packages = {"benchmark/", "malloc.h"},
       .posix = true},
  };
  return table;
}

const std::vector<Sole>& soles() {
  static const std::vector<Sole> table = {
      {"CLI/", "cli/arguments.cpp"},  // three seconds of compiling for each file that includes it
      {"catch2/", "tests/"},

      {"benchmark/", "bench/"},
  };
  return table;
}

}  // namespace shakebed::tests
