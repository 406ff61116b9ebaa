#include <cstdio>

#include "cli/commands.hpp"
#include "files/error.hpp"
#include "fitting/networks/ensemble.hpp"
#include "sweeps/cached_runs.hpp"

namespace shakebed::cli {
namespace {

namespace networks = fitting::networks;
using sweeps::store::Cache;

networks::Snapshot as_network(const simulator::Snapshot& from) {
  std::vector<networks::GrainRow> grains;
  for (std::size_t i = 0; i < from.position.size(); ++i) {
    grains.push_back({static_cast<std::int64_t>(i), from.position[i], from.radius[i]});
  }
  std::vector<networks::ContactRow> contacts;
  for (const auto& contact : from.contacts) {
    const bool wall = contact.j == simulator::SnapshotContact::wall;
    contacts.push_back(
        {contact.i, wall ? std::nullopt : std::optional(contact.j), contact.normal_force});
  }
  const auto row = [&](const char* what) {
    return [&from, what](std::size_t k) {
      return "snapshot " + from.name + ", " + what + " " + std::to_string(k);
    };
  };
  return networks::assemble(from.name, grains, row("grain"), contacts, row("contact"));
}

void add_runs(networks::Ensemble& ensemble, const sweeps::Point& point,
              const std::vector<simulator::Record>& replicas) {
  for (const auto& record : replicas) {
    for (const auto& one : record.snapshots) {
      networks::Member member{as_network(one), {}};
      member.analysis = networks::analyse(member.snapshot, {});
      ensemble.add(point.labels, one.cycles, std::move(member));
    }
  }
}

}  // namespace

int sweep_networks_command(const SweepOptions& options) {
  const sweeps::Grid grid = sweeps::read_grid(options.sweep, options.profile);
  const Cache cache(Cache::place(options.cache));
  files::CsvTable reference;
  if (options.reference) reference = files::CsvTable::read(*options.reference);

  sweeps::Collected collected;
  sweeps::CachedRuns runs(grid, cache);
  networks::Ensemble ensemble(grid.columns);
  std::size_t snapshots = 0;
  for (std::size_t k = 0; k < runs.points(); ++k) {
    const auto replicas = runs.records(k, collected);
    for (const auto& record : replicas) snapshots += record.snapshots.size();
    add_runs(ensemble, runs.point(k), replicas);
  }
  if (snapshots == 0) {
    throw files::failed(options.sweep.string(),
                        "there is no snapshot in the " + std::to_string(collected.runs_present) +
                            " of its " +
                            std::to_string(collected.runs_present + collected.runs_missing) +
                            " runs that " + cache.folder().string() +
                            " has; do `shakebed sweep run` first, with protocol.snapshots in the "
                            "sweep");
  }
  for (auto& [stem, table] : ensemble.tables(reference)) {
    table.provenance = runs.provenance(collected);
    table.write(*options.csv_folder / (stem + ".csv"));
  }
  if (collected.runs_missing > 0) {
    std::fprintf(stderr, "shakebed: warning: %s (%s): %zu runs are missing\n", grid.id.c_str(),
                 grid.profile.c_str(), collected.runs_missing);
  }
  return 0;
}

}  // namespace shakebed::cli
