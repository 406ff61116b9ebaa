#include "sweeps/grid.hpp"

#include <algorithm>
#include <set>

#include "files/yaml.hpp"
#include "simulator/scene/column.hpp"
#include "simulator/scene/read_scene.hpp"
#include "simulator/simulate.hpp"
#include "sweeps/axis.hpp"
#include "sweeps/point_rule.hpp"
#include "sweeps/store/run_key.hpp"

namespace shakebed::sweeps {
namespace {

using files::Error;
using files::Fault;
using files::YamlNode;

constexpr std::size_t most_points = 100000;
constexpr std::size_t most_faults_shown = 20;

/// A sweep file as written, with one profile put in.
struct Plan {
  std::filesystem::path base;
  std::vector<simulator::Override> overrides;
  std::vector<Axis> axes;
  std::vector<PointRule> rules;
};

void replace_choices(const YamlNode& axes, Plan& plan) {
  std::vector<std::string> names;
  for (const auto& axis : plan.axes) {
    if (axis.columns.size() == 1) names.push_back(axis.columns.front().column.name);
  }
  axes.refuse_unknown_keys(names);
  for (const auto& [name, values] : axes.items()) {
    for (auto& axis : plan.axes) {
      auto& column = axis.columns.front();
      if (axis.columns.size() == 1 && column.column.name == name) column.replace_choices(values);
    }
  }
}

void apply_profile(const YamlNode& profile, Plan& plan, Grid& grid) {
  profile.refuse_unknown_keys({"set", "axes", "replicates", "points"});
  if (const auto set = profile.find("set")) {
    const auto more = read_overrides(*set);
    plan.overrides.insert(plan.overrides.end(), more.begin(), more.end());
  }
  if (const auto replicates = profile.find("replicates")) {
    grid.replicates = static_cast<int>(replicates->as_integer());
  }
  if (const auto axes = profile.find("axes")) replace_choices(*axes, plan);
  // Their values are those of the profile's axes.
  if (const auto points = profile.find("points")) {
    plan.rules = read_point_rules(*points, plan.axes);
  }
}

void choose_profile(const YamlNode& root, Plan& plan, Grid& grid) {
  const auto profiles = root.find("profiles");
  if (!profiles) return;
  const auto profile = profiles->find(grid.profile);
  if (!profile) {
    std::string names;
    for (const auto& [name, node] : profiles->items()) names += (names.empty() ? "" : ", ") + name;
    throw profiles->error("there is no profile `" + grid.profile + "`; this sweep has " + names);
  }
  apply_profile(*profile, plan, grid);
}

void check_columns(const Plan& plan, Grid& grid) {
  std::set<std::string> names;
  for (const auto& axis : plan.axes) {
    for (const auto& column : axis.columns) {
      if (!names.insert(column.column.name).second) {
        throw files::bad_input(column.where, "two axes make a column `" + column.column.name +
                                                 "`; name one with `as`");
      }
      grid.columns.push_back(column.column);
      for (const auto& choice : column.choices) {
        for (const auto& set : choice.overrides) {
          grid.seed_is_an_axis = grid.seed_is_an_axis || set.path == "seed";
        }
      }
    }
  }
}

Plan read_plan(const std::filesystem::path& sweep, const YamlNode& root, Grid& grid) {
  root.refuse_unknown_keys({"sweep", "id", "base", "set", "axes", "replicates", "profiles"});
  const YamlNode schema = root.at("sweep");
  if (schema.as_integer() != 1) {
    throw schema.error("this program reads sweeps of schema 1, got " + schema.as_string());
  }
  grid.id = root.at("id").as_string();
  Plan plan;
  plan.base = sweep.parent_path() / root.at("base").as_string();
  if (const auto set = root.find("set")) plan.overrides = read_overrides(*set);
  for (const auto& node : root.at("axes").elements()) plan.axes.push_back(read_axis(node));
  if (const auto replicates = root.find("replicates")) {
    grid.replicates = static_cast<int>(replicates->as_integer());
  }
  choose_profile(root, plan, grid);
  check_columns(plan, grid);
  if (grid.replicates < 1 || grid.replicates > 10000) {
    throw root.error("replicates: expected 1 to 10000, got " + std::to_string(grid.replicates));
  }
  if (grid.seed_is_an_axis && grid.replicates > 1) {
    throw root.error("an axis sets the seed, so replicates must be 1");
  }
  return plan;
}

std::size_t count_points(const Plan& plan, const std::filesystem::path& sweep) {
  std::size_t count = 1;
  for (const auto& axis : plan.axes) {
    count *= axis.size();
    if (count > most_points) {
      throw files::bad_input(
          sweep.string(), "the axes cross to more than " + std::to_string(most_points) + " points");
    }
  }
  return count;
}

/// Faults of many points, each said once, for the first point that has it.
class FaultList {
 public:
  void add(const Error& error, const std::string& point) {
    for (const auto& fault : error.faults()) {
      if (!seen_.insert(fault.where + '\n' + fault.what).second) continue;
      faults_.push_back({fault.where, fault.what + " (at the point " + point + ")"});
    }
  }
  void throw_if_any() {
    if (faults_.empty()) return;
    if (faults_.size() > most_faults_shown) {
      const std::size_t more = faults_.size() - most_faults_shown;
      faults_.resize(most_faults_shown);
      faults_.push_back({"", "... and " + std::to_string(more) + " more"});
    }
    throw Error(Error::Kind::bad_input, std::move(faults_));
  }

 private:
  std::set<std::string> seen_;
  std::vector<Fault> faults_;
};

}  // namespace

std::string Grid::describe(const Point& point) const {
  std::string text;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    text += (text.empty() ? "" : ", ") + columns[k].name + " = " + point.labels[k];
  }
  return text.empty() ? "the only point" : text;
}

Grid read_grid(const std::filesystem::path& sweep, const std::string& profile) {
  const YamlNode root = YamlNode::load_file(sweep);
  Grid grid;
  grid.profile = profile;
  const Plan plan = read_plan(sweep, root, grid);
  const YamlNode base = YamlNode::load_file(plan.base);
  const std::size_t count = count_points(plan, sweep);
  FaultList faults;
  for (std::size_t index = 0; index < count; ++index) {
    Point point;
    auto overrides = plan.overrides;
    std::size_t rest = count;
    for (const auto& axis : plan.axes) {
      rest /= axis.size();
      for (const auto& column : axis.columns) {
        const Choice& choice = column.choices[(index / rest) % axis.size()];
        point.labels.push_back(choice.label);
        overrides.insert(overrides.end(), choice.overrides.begin(), choice.overrides.end());
      }
    }
    for (const auto& rule : plan.rules) {
      if (!rule.applies_to(point.labels)) continue;
      overrides.insert(overrides.end(), rule.overrides.begin(), rule.overrides.end());
    }
    try {
      point.scene = simulator::read_scene(base, overrides);
    } catch (const Error& error) {
      faults.add(error, grid.describe(point));
    }
    grid.points.push_back(std::move(point));
  }
  faults.throw_if_any();
  return grid;
}

std::uint64_t replicate_seed(const simulator::Scene& point, int replicate) {
  // Points that can start from one packing do.
  const std::string depends_on =
      point.column ? simulator::pouring_text(point) : simulator::canonical_yaml(point);
  const std::string text = "replicate " + std::to_string(replicate) + "\n" + depends_on;
  return store::hash(text) & ((std::uint64_t{1} << 53) - 1);
}

std::vector<Run> runs_of(const Grid& grid) {
  std::vector<Run> runs;
  for (std::size_t point = 0; point < grid.points.size(); ++point) {
    for (int replicate = 0; replicate < grid.replicates_of(grid.points[point]); ++replicate) {
      simulator::Scene scene = grid.points[point].scene;
      if (!grid.seed_is_an_axis) scene.seed = replicate_seed(scene, replicate);
      std::string canonical = simulator::canonical_yaml(scene);
      std::string key = store::run_key(canonical, simulator::physics_version, scene.seed);
      runs.push_back({point,
                      replicate,
                      std::move(scene),
                      {std::move(key), std::move(canonical), simulator::physics_version}});
    }
  }
  return runs;
}

}  // namespace shakebed::sweeps
