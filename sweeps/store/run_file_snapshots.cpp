#include "sweeps/store/run_file_snapshots.hpp"

#include <numeric>

#include "files/error.hpp"

namespace shakebed::sweeps::store {
namespace {

using hdf5::Group;
using simulator::Snapshot;
using simulator::SnapshotContact;

constexpr const char* axes[] = {"x", "y", "z"};

Group::Labels unit(const char* text) { return {{{"unit", text}}, {}}; }

void write_grains(const Group& group, const Snapshot& snapshot) {
  group.write_attribute("cycles", snapshot.cycles);
  group.write_attribute("base_height", snapshot.base_height);
  group.write_attribute("base_velocity", snapshot.base_velocity);
  for (std::size_t c = 0; c < 3; ++c) {
    group.write_attribute(std::string("period_") + axes[c], snapshot.period[c]);
  }
  std::vector<std::int64_t> ids(snapshot.position.size());
  std::iota(ids.begin(), ids.end(), 0);
  group.write("id", ids);
  group.write("position", snapshot.position, unit("d"));
  group.write("radius", snapshot.radius, unit("d"));
  group.write("velocity", snapshot.velocity, unit("sqrt(g d)"));
  if (!snapshot.spin.empty()) group.write("spin", snapshot.spin, unit("sqrt(g/d)"));
}

void write_contacts(const Group& group, const Snapshot& snapshot) {
  const auto& contacts = snapshot.contacts;
  std::vector<std::int64_t> i;
  std::vector<std::int64_t> j;
  std::vector<double> force;
  for (const auto& contact : contacts) {
    i.push_back(contact.i);
    j.push_back(contact.j);
    force.push_back(contact.normal_force);
  }
  group.write("i", i);
  group.write("j", j);
  group.write("normal_force", force, unit("m g"));
  if (snapshot.overlap.empty()) return;
  group.write("overlap", snapshot.overlap, unit("d"));
  group.write("normal", snapshot.normal);
  group.write("tangential_force", snapshot.tangential_force, unit("m g"));
}

void require_length(const Group& group, const char* name, std::size_t got, std::size_t expected) {
  if (got == expected) return;
  throw files::failed(group.where() + "/" + name,
                      "expected " + std::to_string(expected) + " rows, got " + std::to_string(got));
}

Snapshot read_grains(const Group& group, const std::string& name) {
  Snapshot snapshot;
  snapshot.name = name;
  snapshot.cycles = group.number_attribute("cycles");
  snapshot.base_height = group.number_attribute("base_height");
  snapshot.base_velocity = group.number_attribute("base_velocity");
  for (std::size_t c = 0; c < 3; ++c) {
    snapshot.period[c] = group.number_attribute(std::string("period_") + axes[c]);
  }
  snapshot.position = group.triples("position");
  snapshot.radius = group.numbers("radius");
  snapshot.velocity = group.triples("velocity");
  const std::size_t grains = snapshot.position.size();
  require_length(group, "radius", snapshot.radius.size(), grains);
  require_length(group, "velocity", snapshot.velocity.size(), grains);
  if (group.has("spin")) {
    snapshot.spin = group.triples("spin");
    require_length(group, "spin", snapshot.spin.size(), grains);
  }
  return snapshot;
}

void read_contacts(const Group& group, Snapshot& snapshot) {
  const auto i = group.integers("i");
  const auto j = group.integers("j");
  const auto force = group.numbers("normal_force");
  require_length(group, "j", j.size(), i.size());
  require_length(group, "normal_force", force.size(), i.size());
  for (std::size_t k = 0; k < i.size(); ++k) snapshot.contacts.push_back({i[k], j[k], force[k]});
  if (!group.has("overlap")) return;
  snapshot.overlap = group.numbers("overlap");
  snapshot.normal = group.triples("normal");
  snapshot.tangential_force = group.triples("tangential_force");
  require_length(group, "overlap", snapshot.overlap.size(), i.size());
  require_length(group, "normal", snapshot.normal.size(), i.size());
  require_length(group, "tangential_force", snapshot.tangential_force.size(), i.size());
}

}  // namespace

void write_snapshots(const Group& root, const std::vector<Snapshot>& snapshots) {
  if (snapshots.empty()) return;
  const Group grains = root.make_group("snapshots");
  const Group contacts = root.make_group("contacts");
  for (const auto& snapshot : snapshots) {
    write_grains(grains.make_group(snapshot.name), snapshot);
    write_contacts(contacts.make_group(snapshot.name), snapshot);
  }
}

std::vector<Snapshot> read_snapshots(const Group& root) {
  std::vector<Snapshot> snapshots;
  if (!root.has("snapshots")) return snapshots;
  const Group grains = root.group("snapshots");
  const Group contacts = root.group("contacts");
  for (const auto& name : grains.names()) {
    snapshots.push_back(read_grains(grains.group(name), name));
    read_contacts(contacts.group(name), snapshots.back());
  }
  return snapshots;
}

}  // namespace shakebed::sweeps::store
