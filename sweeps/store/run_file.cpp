#include "sweeps/store/run_file.hpp"

#include <fstream>

#include "files/atomic_file.hpp"
#include "files/build_info.hpp"
#include "files/error.hpp"
#include "sweeps/store/hdf5.hpp"
#include "sweeps/store/run_file_snapshots.hpp"

namespace shakebed::sweeps::store {
namespace {

using hdf5::Group;
using simulator::Record;

constexpr std::string_view format_word = "shakebed run";

std::string cpu_model() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) {
      return line.substr(colon + 2);
    }
  }
  return "unknown";
}

void write_scene(const Group& root, const Record& record) {
  const Group scene = root.make_group("scene");
  scene.write_attribute("dimension", std::int64_t{record.dimension});
  scene.write("canonical_yaml", std::vector{record.canonical_scene});
}

void write_averages(const Group& root, const Record& record) {
  const Group averages = root.make_group("averages");
  for (const auto& quantity : record.quantities) {
    averages.write(quantity.name, {quantity.estimate}, {{{"unit", quantity.unit}}, {}});
  }
  const Group scalars = root.make_group("scalars");
  for (const auto& scalar : record.scalars) {
    scalars.write(scalar.name, std::vector{scalar.value}, {{{"unit", scalar.unit}}, {}});
  }
}

void write_series(const Group& root, const Record& record) {
  const Group group = root.make_group("series");
  for (const auto& series : record.series) {
    group.write(series.name, series.values,
                {{{"unit", series.unit}}, {{"cycles_per_entry", series.cycles_per_entry}}});
  }
}

void write_profile(const Group& root, const simulator::Profile& profile) {
  const Group group = root.make_group("profiles");
  group.write_attribute("box_depth", profile.box_depth);
  group.write("z", profile.z, {{{"unit", "d"}}, {}});
  for (const auto& column : profile.columns) {
    if (column.mean.size() != column.standard_error.size()) {
      throw files::failed(group.where() + "/" + column.name,
                          "has not as many standard errors as means");
    }
    std::vector<simulator::Estimate> boxes;
    for (std::size_t k = 0; k < column.mean.size(); ++k) {
      boxes.push_back({column.mean[k], column.standard_error[k]});
    }
    group.write(column.name, boxes, {{{"unit", column.unit}}, {}});
  }
}

void write_verdict(const Group& root, const Record& record) {
  const Group verdict = root.make_group("verdict");
  verdict.write_attribute("stationary", std::int64_t{record.stationary});
  verdict.write_attribute("stationary_reason", record.stationary_reason);
  verdict.write_attribute("at_rest", std::int64_t{record.at_rest});
  verdict.write("warnings", record.warnings);
}

void write_provenance(const Group& root, const Record& record, const Provenance& provenance) {
  const Group group = root.make_group("provenance");
  group.write_attribute("physics_version", std::int64_t{record.physics_version});
  group.write_attribute("seed", record.seed);
  group.write_attribute("shakebed_version", provenance.shakebed_version);
  group.write_attribute("git_revision", provenance.git_revision);
  group.write_attribute("compiler", provenance.compiler);
  group.write_attribute("compiler_flags", provenance.compiler_flags);
  group.write_attribute("machine", provenance.machine);
  group.write_attribute("preset", provenance.preset);
  group.write_attribute("cpu", provenance.cpu);
}

void write_timing(const Group& root, const simulator::Timing& timing) {
  const Group group = root.make_group("timing");
  group.write_attribute("cpu_seconds", timing.cpu_seconds);
  group.write_attribute("cpu_seconds_measuring", timing.cpu_seconds_measuring);
  group.write_attribute("wall_seconds", timing.wall_seconds);
}

void require_schema(const Group& root, const std::string& file) {
  if (!root.has_attribute("format") || root.text_attribute("format") != format_word) {
    throw files::bad_input(file, "is an HDF5 file, but not a run file of shakebed");
  }
  const std::int64_t schema = root.integer_attribute("schema");
  if (schema != run_file_schema) {
    throw files::bad_input(file, "is a run file from another schema: expected schema " +
                                     std::to_string(run_file_schema) + ", got " +
                                     std::to_string(schema) +
                                     "; use another --cache, or the shakebed that wrote it");
  }
}

template <class T>
T only_entry(std::vector<T> values, const std::string& where) {
  if (values.size() != 1) {
    throw files::failed(where, "expected one entry, got " + std::to_string(values.size()));
  }
  return std::move(values.front());
}

void read_scene(const Group& root, Record& record) {
  const Group scene = root.group("scene");
  record.dimension = static_cast<int>(scene.integer_attribute("dimension"));
  record.canonical_scene =
      only_entry(scene.texts("canonical_yaml"), scene.where() + "/canonical_yaml");
}

void read_averages(const Group& root, Record& record) {
  const Group averages = root.group("averages");
  for (const auto& name : averages.names()) {
    record.quantities.push_back(
        {name, averages.text_attribute("unit", name),
         only_entry(averages.estimates(name), averages.where() + "/" + name)});
  }
  const Group scalars = root.group("scalars");
  for (const auto& name : scalars.names()) {
    record.scalars.push_back({name, scalars.text_attribute("unit", name),
                              only_entry(scalars.numbers(name), scalars.where() + "/" + name)});
  }
}

void read_series(const Group& root, Record& record) {
  const Group group = root.group("series");
  for (const auto& name : group.names()) {
    record.series.push_back({name, group.text_attribute("unit", name),
                             group.number_attribute("cycles_per_entry", name),
                             group.numbers(name)});
  }
}

void read_profile(const Group& root, simulator::Profile& profile) {
  const Group group = root.group("profiles");
  profile.box_depth = group.number_attribute("box_depth");
  profile.z = group.numbers("z");
  for (const auto& name : group.names()) {
    if (name == "z") continue;
    simulator::ProfileColumn column{name, group.text_attribute("unit", name), {}, {}};
    for (const auto& box : group.estimates(name)) {
      column.mean.push_back(box.mean);
      column.standard_error.push_back(box.standard_error);
    }
    profile.columns.push_back(std::move(column));
  }
}

void read_verdict(const Group& root, Record& record) {
  const Group verdict = root.group("verdict");
  record.stationary = verdict.integer_attribute("stationary") != 0;
  record.stationary_reason = verdict.text_attribute("stationary_reason");
  record.at_rest = verdict.integer_attribute("at_rest") != 0;
  record.warnings = verdict.texts("warnings");
}

Provenance read_provenance(const Group& root, Record& record) {
  const Group group = root.group("provenance");
  record.physics_version = static_cast<int>(group.integer_attribute("physics_version"));
  record.seed = group.unsigned_attribute("seed");
  return {group.text_attribute("shakebed_version"),
          group.text_attribute("git_revision"),
          group.text_attribute("compiler"),
          group.text_attribute("compiler_flags"),
          group.text_attribute("machine"),
          group.text_attribute("preset"),
          group.text_attribute("cpu")};
}

void read_timing(const Group& root, simulator::Timing& timing) {
  const Group group = root.group("timing");
  timing.cpu_seconds = group.number_attribute("cpu_seconds");
  timing.cpu_seconds_measuring = group.number_attribute("cpu_seconds_measuring");
  timing.wall_seconds = group.number_attribute("wall_seconds");
}

std::string image_of(const std::string& name, const Record& record, const Provenance& provenance) {
  hdf5::File memory = hdf5::File::create(name);
  const Group& root = memory.root();
  root.write_attribute("format", format_word);
  root.write_attribute("schema", std::int64_t{run_file_schema});
  write_scene(root, record);
  write_averages(root, record);
  write_series(root, record);
  write_profile(root, record.profile);
  write_snapshots(root, record.snapshots);
  write_verdict(root, record);
  write_provenance(root, record, provenance);
  write_timing(root, record.timing);
  return std::move(memory).finish();
}

}  // namespace

Provenance provenance_of_this_program() {
  static const std::string cpu = cpu_model();
  return {std::string(files::version()),
          std::string(files::git_revision()),
          std::string(files::compiler()),
          std::string(files::compiler_flags()),
          std::string(files::machine()),
          std::string(files::preset()),
          cpu};
}

void write_run_file(const std::filesystem::path& file, const Record& record,
                    const Provenance& provenance) {
  files::write_text(file, image_of(file.string(), record, provenance));
}

RunFile read_run_file(const std::filesystem::path& file) {
  const hdf5::File memory = hdf5::File::open(file.string(), files::read_text(file));
  const Group& root = memory.root();
  require_schema(root, file.string());
  RunFile run;
  read_scene(root, run.record);
  read_averages(root, run.record);
  read_series(root, run.record);
  read_profile(root, run.record.profile);
  run.record.snapshots = read_snapshots(root);
  read_verdict(root, run.record);
  run.provenance = read_provenance(root, run.record);
  read_timing(root, run.record.timing);
  return run;
}

}  // namespace shakebed::sweeps::store
