#include "simulator/scene/column.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "files/csv.hpp"
#include "simulator/contact/column_parameters.hpp"
#include "simulator/scene/warnings.hpp"

namespace shakebed::simulator {
namespace {

using files::number_text;

std::string three_digits(double value) { return files::rounded_text(value, 3); }

constexpr std::array only_in_container{"grains.sizes",
                                       "grains.large",
                                       "contact.gamma_n",
                                       "contact.tangential.stiffness_ratio",
                                       "contact.tangential.gamma_t",
                                       "drag",
                                       "protocol.prepare",
                                       "protocol.time_step.value",
                                       "protocol.contact_velocities",
                                       "protocol.list_skin",
                                       "protocol.snapshots.from_cycle"};
constexpr std::array not_in_container{"contact.allow_soft",
                                      "lid",
                                      "side_walls",
                                      "base.moves_along",
                                      "cell",
                                      "cell_mm",
                                      "grains.layers",
                                      "grains.restitution",
                                      "base.restitution",
                                      "base.friction",
                                      "contact.tangential.damping",
                                      "protocol.settle",
                                      "protocol.profile",
                                      "protocol.transient",
                                      "protocol.measure.until",
                                      "protocol.measure.at_most",
                                      "protocol.measure.errors",
                                      "protocol.contacts"};

/// A length in d, given so or in mm; the mm key's name is the other's with `_mm`.
std::optional<double> length(SceneValues& values, const std::string& path,
                             std::optional<double> diameter_mm) {
  const std::string in_mm = path + "_mm";
  if (values.given(path) && values.given(in_mm)) {
    values.report(in_mm, "`" + path + "` and `" + in_mm + "` are both given; keep one");
  }
  if (const auto value = values.number(path)) return value;
  const auto value = values.number(in_mm);
  if (!value) return std::nullopt;
  if (!diameter_mm) {
    values.report(in_mm, "`" + in_mm +
                             "` has a physical unit, so the scene must say how large a grain is: "
                             "units: {diameter: 2 mm}");
    return std::nullopt;
  }
  const double reduced = *value / *diameter_mm;
  const Range& range = find_scene_key(path)->range;
  if (!range.contains(reduced)) {
    values.report(in_mm, "`" + in_mm + "` comes to " + number_text(reduced) +
                             " d; expected a value in " + range.text() + " d");
  }
  return reduced;
}

void read_sizes(SceneValues& values, ColumnScene& column) {
  const auto sizes = values.numbers("grains.sizes");
  if (!sizes) return;
  if (sizes->size() != 2 || sizes->front() > sizes->back()) {
    values.report("grains.sizes",
                  "`grains.sizes`: expected [smallest, largest], such as [0.9, 1.1]");
    return;
  }
  column.smallest = sizes->front();
  column.largest = sizes->back();
}

void read_large(SceneValues& values, ColumnScene& column, std::optional<double> diameter_mm) {
  if (!values.given("grains.large") || values.refused("grains.large")) return;
  const auto diameter = length(values, "grains.large.diameter", diameter_mm);
  if (!diameter) {
    values.report("grains.large", "`grains.large` needs `diameter` (or `diameter_mm`)");
    return;
  }
  column.has_large = true;
  column.large_diameter = *diameter;
  const auto density = values.number("grains.large.density");
  const auto ratio = values.number("grains.large.density_ratio");
  if (density && ratio) {
    values.report(
        "grains.large.density_ratio",
        "`grains.large.density` and `grains.large.density_ratio` are both given; keep one");
  }
  constexpr double small_density = 6 / std::numbers::pi;  // m/d^3
  column.large_density = density ? *density / small_density : ratio.value_or(1);
  // A small grain must be able to pass beside it, or it is a piston.
  const double room = column.diameter - column.large_diameter;
  if (room < column.largest && column.diameter >= 2 * column.largest) {
    values.report("grains.large",
                  "a large grain of " + number_text(column.large_diameter) +
                      " d leaves no room for a small one beside it in a cylinder of " +
                      number_text(column.diameter) + " d; it may have at most " +
                      number_text(std::floor(100 * (column.diameter - column.largest)) / 100) +
                      " d");
  }
}

void read_springs(SceneValues& values, Scene& scene) {
  ColumnScene& column = *scene.column;
  const auto gamma_n = values.number("contact.gamma_n");
  if (!gamma_n && !values.refused("contact.gamma_n")) {
    values.report("contact.gamma_n",
                  "the key `contact.gamma_n` is missing: the normal damping of contacts in a "
                  "container, F_n = k_n delta - gamma_n m_eff v_n, such as 40");
  }
  if (!scene.contact.stiffness && !values.refused("contact.stiffness")) {
    values.report("contact.stiffness",
                  "`contact.stiffness` must be a number in a container, such as 2e5");
  }
  if (const auto normal = values.word("contact.normal"); normal == "hertz") {
    column.overlap_law = OverlapLaw::hertz;
  }
  const std::string tangential = "contact.tangential";
  const auto law = values.word(tangential + ".law");
  if (law == "viscous_coulomb") {
    values.report(tangential + ".law",
                  "viscous_coulomb is for periodic beds; contacts in a container have springs with "
                  "memory: law: cundall_strack");
  }
  const bool smooth = law == "frictionless" || values.word(tangential) == "frictionless";
  const double mu = values.number("grains.friction").value_or(0);
  const double mu_wall = values.number("container.wall.friction").value_or(mu);
  if (smooth && (mu != 0 || mu_wall != 0)) {
    values.report(tangential,
                  "`contact.tangential` is frictionless, but a friction coefficient is "
                  "not 0; write law: cundall_strack, or friction: 0");
  }
  const double k_n = scene.contact.stiffness.value_or(1);
  const double ratio = values.number(tangential + ".stiffness_ratio").value_or(2.0 / 7);
  column.grain_stiffness_ratio = ratio;
  column.wall_stiffness_ratio = values.number("container.wall.stiffness_ratio").value_or(ratio);
  column.grain = {k_n, ratio * k_n, gamma_n.value_or(0),
                  values.number(tangential + ".gamma_t").value_or(0), mu};
  const std::string wall = "container.wall";
  const double wall_k_n = values.number(wall + ".stiffness").value_or(k_n);
  column.wall = {wall_k_n, column.wall_stiffness_ratio * wall_k_n,
                 values.number(wall + ".gamma_n").value_or(column.grain.normal_rate),
                 values.number(wall + ".gamma_t").value_or(column.grain.tangential_rate), mu_wall};
}

/// The large grain sinks in by its weight where the base pushes hardest, M (g + A omega^2)/k_n.
void check_large_overlap(SceneValues& values, const Scene& scene) {
  const ColumnScene& column = *scene.column;
  if (!column.has_large || !scene.contact.stiffness || scene.gravity == 0) return;
  const double mass = column.large_density * std::pow(column.large_diameter, 3);
  const double k_n = std::min(column.grain.normal_stiffness, column.wall.normal_stiffness);
  const double overlap = mass * (1 + scene.Gamma()) / k_n;
  if (overlap <= meaningless_overlap) return;
  values.report("grains.large", "a large grain of " + three_digits(mass) + " m sinks about " +
                                    three_digits(overlap) +
                                    " d into its neighbours at k_n = " + three_digits(k_n) +
                                    " m g/d; at most " + three_digits(meaningless_overlap) +
                                    " d means anything: make it lighter or the contacts stiffer");
}

void read_time_step(SceneValues& values, Scene& scene) {
  ColumnScene& column = *scene.column;
  column.time_step = values.number("protocol.time_step.value");
  const std::string path = "protocol.time_step.value";
  if (column.time_step && values.given("protocol.time_step.fraction_of_contact_duration")) {
    values.report(path,
                  "`protocol.time_step.value` and `fraction_of_contact_duration` are both "
                  "given; keep one");
  }
  const auto p = bind_column(scene);
  constexpr double coarsest = 1.0 / 20;  // of t_c; as for fraction_of_contact_duration
  constexpr double advised = 1.0 / 25;
  const bool allowed = values.boolean("protocol.time_step.allow_coarse").value_or(false);
  const bool coarse = p.time_step > coarsest * p.contact_duration;
  if (coarse && !allowed) {
    const bool as_value = column.time_step.has_value();
    values.report(
        as_value ? path : "protocol.time_step.fraction_of_contact_duration",
        "a step of " + three_digits(p.time_step) + " is t_c/" +
            three_digits(p.contact_duration / p.time_step) +
            " of the shortest contact; write at most " +
            (as_value ? three_digits(advised * p.contact_duration) + " (t_c/25)"
                      : three_digits(coarsest) + " (better " + three_digits(advised) + ")") +
            ", or allow_coarse: true beside it");
  }
  scene.protocol.allow_coarse_time_step = coarse;
}

void read_snapshots_of_column(SceneValues& values, Scene& scene) {
  auto& wanted = scene.protocol.snapshots;
  wanted.from_cycle =
      values.integer("protocol.snapshots.from_cycle").value_or(default_snapshot_cycle);
  const bool default_fits = scene.protocol.cycles && *scene.protocol.cycles > wanted.from_cycle;
  if (!values.given("protocol.snapshots") && default_fits) {
    for (int k = 0; k < 20; ++k) wanted.phases.push_back(0.05 * k);
  }
  if (wanted.phases.empty()) {
    wanted.from_cycle = 0;
    return;
  }
  const long cycles = scene.protocol.cycles.value_or(0);
  if (wanted.from_cycle + wanted.cycles > cycles) {
    values.report("protocol.snapshots",
                  "snapshots of cycles " + std::to_string(wanted.from_cycle) + " to " +
                      std::to_string(wanted.from_cycle + wanted.cycles - 1) +
                      " are asked for, but only " + std::to_string(cycles) + " are run");
  }
}

}  // namespace

void refuse_column_keys(SceneValues& values) {
  for (const std::string path : only_in_container) {
    if (!values.given(path)) continue;
    values.report(path, "`" + path +
                            "` belongs to beds in a container; add container: {cylinder: "
                            "{diameter: 12}}, or remove it");
  }
  const auto refuse_law = [&](const std::string& path, const char* law) {
    if (values.word(path) != law) return;
    values.report(path, "`" + path + "`: " + law +
                            " belongs to beds in a container; add container: {cylinder: "
                            "{diameter: 12}}, or write another law");
  };
  refuse_law("contact.normal", "hertz");
  refuse_law("contact.tangential.law", "cundall_strack");
}

void read_column(SceneValues& values, Scene& scene, std::optional<double> diameter_mm) {
  ColumnScene& column = scene.column.emplace();
  for (const std::string path : not_in_container) {
    if (!values.given(path)) continue;
    values.report(path, "`" + path + "` means nothing to a bed in a container; remove it");
  }
  if (scene.dimension != 3) values.report("dimension", "a container needs dimension: 3");
  if (values.word("protocol.engine") == "events") {
    values.report("protocol.engine", "beds in a container are stepped; write auto or uniform");
  }
  const auto diameter = length(values, "container.cylinder.diameter", diameter_mm);
  if (!diameter) {
    if (!values.refused("container.cylinder.diameter")) {
      values.report("container", "`container` needs cylinder: {diameter: 12}");
    }
    return;
  }
  column.diameter = *diameter;
  if (!values.given("grains.count"))
    values.report("grains", "`grains` needs `count` in a container");
  read_sizes(values, column);
  if (column.diameter < 2 * column.largest) {
    values.report("container.cylinder", "a cylinder of " + number_text(column.diameter) +
                                            " d is narrower than two grains");
  }
  read_large(values, column, diameter_mm);
  if (values.word("container.frame") == "co_moving") column.frame = ContainerFrame::co_moving;
  read_springs(values, scene);
  column.background_damping = values.number("drag.background").value_or(0);
  column.air_damping = values.number("drag.air").value_or(0);
  column.air_packing_fraction = values.number("drag.air_packing_fraction").value_or(0.6);
  column.predict_velocities = values.word("protocol.contact_velocities") != "half_step";
  column.list_skin = values.number("protocol.list_skin").value_or(column.list_skin);
  const std::string prepare = "protocol.prepare.";
  column.prepare_frequency = values.number(prepare + "frequency").value_or(1.5);
  column.prepare_Gamma = values.number(prepare + "Gamma").value_or(4);
  column.prepare_kinetic_energy = values.number(prepare + "kinetic_energy").value_or(1e-6);
  if (!scene.protocol.cycles) {
    values.report("protocol.measure",
                  "a bed in a container is run for a number of cycles: measure: {cycles: 40}");
  }
  scene.protocol.until.reset();
  scene.grains.count = static_cast<int>(values.integer("grains.count").value_or(1));
  scene.grains.layers = scene.grains.count / scene.cell_area();
  check_large_overlap(values, scene);
  read_time_step(values, scene);
  read_snapshots_of_column(values, scene);
}

}  // namespace shakebed::simulator
