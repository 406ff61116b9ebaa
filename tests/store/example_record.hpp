#pragma once

#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <limits>
#include <string>

#include "simulator/record.hpp"

namespace shakebed::tests {

/// A folder that is gone when the test ends.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "shakebed-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A record that uses every member, with the values that text or float formats lose: NaN,
/// infinities, a denormal, negative zero, 64-bit integers, UTF-8, empty lists and texts.
inline simulator::Record example_record() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  simulator::Record record;
  record.physics_version = 7;
  record.seed = 0xfedcba9876543210U;
  record.dimension = 3;
  record.canonical_scene = "scene: 1\nseed: 18364758544493064720\n# \xc2\xb5 = 0.4\n";
  record.quantities = {{"T_z", "m g d", {0.1 + 0.2, 1e-3}},
                       {"T_z_scaled", "m V_p^2", {5e-324, nan}},
                       {"h_cm", "d", {-0.0, 0}},
                       {"a_last_name_first", "1", {1.0 / 3, 2.0 / 3}}};
  record.scalars = {{"k_n", "m g/d", 2e5}, {"Gamma", "1", std::numeric_limits<double>::infinity()}};
  record.series = {{"T_z", "m g d", 8, {}}, {"base_power", "m g sqrt(g d)", 16, {1, 2, nan}}};
  record.series.back().values.resize(20000, 0.1);  // more than one chunk
  record.profile.box_depth = 0.5;
  record.profile.z = {0.25, 0.75};
  record.profile.columns = {{"phi", "1", {0.3, 0.1}, {0.01, nan}},
                            {"T_z", "m g d", {2, 3}, {1, 1}}};
  simulator::Snapshot snapshot;
  snapshot.name = "T10.05";
  snapshot.cycles = 10.05;
  snapshot.base_height = -0.1;
  snapshot.base_velocity = 4.7;
  snapshot.period = {5, 0, 0};
  snapshot.radius = {0.5, 1.58};
  snapshot.position = {{1, 2, -0.0}, {5e-324, 4, 1e300}};
  snapshot.velocity = {{0, 0, nan}, {-1, 0, 1}};
  snapshot.spin = {{0, 3, 0}, {0, -4, 0}};
  snapshot.contacts = {{0, 1, -0.25}, {0, simulator::SnapshotContact::wall, 12}};
  record.snapshots.push_back(snapshot);
  snapshot.name = "T11";  // nothing touches, nothing spins
  snapshot.spin.clear();
  snapshot.contacts.clear();
  record.snapshots.push_back(snapshot);
  record.stationary = true;
  record.stationary_reason = "";
  record.at_rest = true;
  record.warnings = {"", "omega t_c is 0.22 rad", "a longer warning than the others \xe2\x80\xa6"};
  record.timing = {12.5, 11.25, 13.75};
  return record;
}

inline bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

inline bool same_bits(const std::vector<std::array<double, 3>>& a,
                      const std::vector<std::array<double, 3>>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
}

inline bool same_snapshot(const simulator::Snapshot& a, const simulator::Snapshot& b) {
  bool same = a.name == b.name && same_bits(a.cycles, b.cycles) &&
              same_bits(a.base_height, b.base_height) &&
              same_bits(a.base_velocity, b.base_velocity) && a.period == b.period &&
              same_bits(a.radius, b.radius) && same_bits(a.position, b.position) &&
              same_bits(a.velocity, b.velocity) && same_bits(a.spin, b.spin) &&
              a.contacts.size() == b.contacts.size();
  for (std::size_t k = 0; same && k < a.contacts.size(); ++k) {
    same = a.contacts[k].i == b.contacts[k].i && a.contacts[k].j == b.contacts[k].j &&
           same_bits(a.contacts[k].normal_force, b.contacts[k].normal_force);
  }
  return same;
}

/// Bit for bit, the order of names included; timing only when asked for.
inline bool same_record(const simulator::Record& a, const simulator::Record& b,
                        bool timing_too = false) {
  bool same = a.physics_version == b.physics_version && a.seed == b.seed &&
              a.dimension == b.dimension && a.canonical_scene == b.canonical_scene &&
              a.stationary == b.stationary && a.stationary_reason == b.stationary_reason &&
              a.at_rest == b.at_rest && a.warnings == b.warnings &&
              a.quantities.size() == b.quantities.size() && a.scalars.size() == b.scalars.size() &&
              a.series.size() == b.series.size() && same_bits(a.profile.z, b.profile.z) &&
              same_bits(a.profile.box_depth, b.profile.box_depth) &&
              a.profile.columns.size() == b.profile.columns.size() &&
              a.snapshots.size() == b.snapshots.size();
  for (std::size_t k = 0; same && k < a.snapshots.size(); ++k) {
    same = same_snapshot(a.snapshots[k], b.snapshots[k]);
  }
  for (std::size_t k = 0; same && k < a.quantities.size(); ++k) {
    const auto& p = a.quantities[k];
    const auto& q = b.quantities[k];
    same = p.name == q.name && p.unit == q.unit && same_bits(p.estimate.mean, q.estimate.mean) &&
           same_bits(p.estimate.standard_error, q.estimate.standard_error);
  }
  for (std::size_t k = 0; same && k < a.scalars.size(); ++k) {
    same = a.scalars[k].name == b.scalars[k].name && a.scalars[k].unit == b.scalars[k].unit &&
           same_bits(a.scalars[k].value, b.scalars[k].value);
  }
  for (std::size_t k = 0; same && k < a.series.size(); ++k) {
    same = a.series[k].name == b.series[k].name && a.series[k].unit == b.series[k].unit &&
           same_bits(a.series[k].cycles_per_entry, b.series[k].cycles_per_entry) &&
           same_bits(a.series[k].values, b.series[k].values);
  }
  for (std::size_t k = 0; same && k < a.profile.columns.size(); ++k) {
    const auto& p = a.profile.columns[k];
    const auto& q = b.profile.columns[k];
    same = p.name == q.name && p.unit == q.unit && same_bits(p.mean, q.mean) &&
           same_bits(p.standard_error, q.standard_error);
  }
  if (timing_too) {
    same = same && same_bits(a.timing.cpu_seconds, b.timing.cpu_seconds) &&
           same_bits(a.timing.cpu_seconds_measuring, b.timing.cpu_seconds_measuring) &&
           same_bits(a.timing.wall_seconds, b.timing.wall_seconds);
  }
  return same;
}

}  // namespace shakebed::tests
