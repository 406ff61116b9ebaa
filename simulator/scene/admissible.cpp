#include "simulator/scene/admissible.hpp"

#include <algorithm>
#include <cmath>

#include "files/csv.hpp"
#include "simulator/scene/accuracy.hpp"
#include "simulator/scene/column.hpp"
#include "simulator/scene/warnings.hpp"

namespace shakebed::simulator {

namespace {

using files::number_text;

constexpr double standard_gravity = 9.81;       // m/s2, when units.gravity is not given
constexpr double coarse_time_step = 0.2;        // of t_c
constexpr double coarse_in_container = 0.05;    // of t_c; no contact there is in closed form
constexpr double whole_count_tolerance = 1e-6;  // relative; layers are written with few digits
const std::vector<std::string> until_quantities{"T_z", "T_x", "T_y", "T"};

std::optional<double> diameter_from(SceneValues& values) {
  if (values.given("units.diameter") && values.given("grains.diameter_mm")) {
    values.report("grains.diameter_mm",
                  "`grains.diameter_mm` and `units.diameter` say the same thing; keep one");
  }
  const auto unit = values.number("units.diameter");
  return unit ? unit : values.number("grains.diameter_mm");
}

std::vector<double> cell_from(SceneValues& values, std::optional<double> diameter_mm) {
  if (values.refused("cell")) return {};
  if (values.given("cell") == values.given("cell_mm")) {
    values.report("cell", values.given("cell") ? "`cell` and `cell_mm` are both given; keep one"
                                               : "the key `cell` is missing: the periodic "
                                                 "lateral widths, such as [5, 5] in 3D or [10] in "
                                                 "2D (or `cell_mm`, or a `container`)");
    return {};
  }
  if (const auto widths = values.numbers("cell")) return *widths;
  std::vector<double> widths = values.numbers("cell_mm").value_or(std::vector<double>{});
  if (!widths.empty() && !diameter_mm) {
    values.report("cell_mm",
                  "`cell_mm` has a physical unit, so the scene must say how large a "
                  "grain is: units: {diameter: 5 mm}");
    return {};
  }
  const Range& range = find_scene_key("cell")->range;
  for (double& width : widths) {
    width /= *diameter_mm;
    if (!range.contains(width)) {
      values.report("cell_mm", "`cell_mm` comes to " + number_text(width) +
                                   " d; expected a width in " + range.text() + " d");
    }
  }
  return widths;
}

void check_cell_dimension(SceneValues& values, const Scene& scene) {
  const bool known = values.integer("dimension").has_value() && !scene.cell.empty();
  const auto wanted = static_cast<std::size_t>(scene.dimension - 1);
  if (!known || scene.cell.size() == wanted) return;
  const std::string path = values.given("cell") ? "cell" : "cell_mm";
  values.report(path, "`" + path + "`: expected " + std::to_string(wanted) +
                          (wanted == 1 ? " width" : " widths") + " in dimension " +
                          std::to_string(scene.dimension) + ", got " +
                          std::to_string(scene.cell.size()));
}

/// N = count d^2/(L_x L_y), or count d/L_x in 2D: one from the other.
void count_and_layers(SceneValues& values, Scene& scene) {
  if (values.refused("grains.count") || values.refused("grains.layers")) return;
  if (values.given("grains.count") == values.given("grains.layers")) {
    values.report("grains", values.given("grains.count")
                                ? "`grains.count` and `grains.layers` are both given; keep one"
                                : "`grains` needs `layers` or `count`");
    return;
  }
  if (scene.cell.empty()) return;
  const double area = scene.cell_area();
  if (const auto layers = values.number("grains.layers")) {
    const double count = *layers * area;
    const double nearest = std::max(1.0, std::round(count));
    if (std::abs(count - nearest) > whole_count_tolerance * nearest) {
      values.report("grains.layers", "`grains.layers`: " + number_text(*layers) +
                                         " layers on this cell come to " + number_text(count) +
                                         " grains; write count: " + number_text(nearest) +
                                         ", which is " + number_text(nearest / area) + " layers");
    } else if (nearest > 1e6) {
      values.report("grains.layers", "`grains.layers` comes to " + number_text(nearest) +
                                         " grains; at most 1e6 are simulated");
    }
    scene.grains.count = static_cast<int>(std::min(nearest, 1e6));
  } else if (const auto count = values.integer("grains.count")) {
    scene.grains.count = static_cast<int>(*count);
  }
  scene.grains.layers = scene.grains.count / area;
}

TangentialLaw law_from(SceneValues& values, bool any_friction) {
  const std::string path = "contact.tangential";
  if (values.refused(path)) return TangentialLaw::viscous_coulomb;
  if (values.word(path)) return TangentialLaw::frictionless;  // the only word of that row
  if (!values.given(path)) {
    return any_friction ? TangentialLaw::viscous_coulomb : TangentialLaw::frictionless;
  }
  const auto law = values.word(path + ".law");
  if (!law && !values.given(path + ".law")) {
    values.report(path, "`contact.tangential` needs `law`: {law: viscous_coulomb, damping: c_n}");
  }
  if (law != "frictionless") return TangentialLaw::viscous_coulomb;
  if (values.given(path + ".damping")) {
    values.report(path + ".damping",
                  "`contact.tangential.damping` means nothing to the law frictionless; remove it "
                  "or write law: viscous_coulomb");
  }
  return TangentialLaw::frictionless;
}

void read_tangential(SceneValues& values, Scene& scene) {
  auto& contact = scene.contact;
  const bool any_friction = scene.any_friction();
  contact.tangential = law_from(values, any_friction);
  if (contact.tangential == TangentialLaw::frictionless) {
    for (const std::string key :
         {"grains.friction", "base.friction", "lid.friction", "side_walls.friction"}) {
      if (values.number(key).value_or(0) == 0) continue;
      values.report(key, "`" + key +
                             "` is not 0, but `contact.tangential` is frictionless; write "
                             "tangential: {law: viscous_coulomb, damping: c_n}, or friction: 0");
    }
    return;
  }
  if (!any_friction) {
    // A friction force bounded by 0 is none: the same bed must have the same canonical text.
    contact.tangential = TangentialLaw::frictionless;
    return;
  }
  const std::string damping = "contact.tangential.damping";
  if (const auto value = values.number(damping)) {
    contact.damping = TangentialDamping::value;
    contact.damping_value = *value;
  } else if (values.word(damping) == "critical") {
    contact.damping = TangentialDamping::critical;
  }
}

void read_measure(SceneValues& values, Scene& scene) {
  const std::string measure = "protocol.measure";
  auto& protocol = scene.protocol;
  protocol.cautious_errors = values.word(measure + ".errors") != "window";
  const bool cycles = values.given(measure + ".cycles");
  if (cycles) {
    protocol.cycles = values.integer(measure + ".cycles").value_or(1);
    for (const std::string other : {".until", ".at_most"}) {
      if (values.given(measure + other)) {
        values.report(measure + other, "`" + measure + other +
                                           "` and `protocol.measure.cycles` exclude each other; "
                                           "keep one");
      }
    }
    return;
  }
  protocol.at_most = values.integer(measure + ".at_most").value_or(protocol.at_most);
  std::vector<std::string> wanted;
  for (const auto& quantity : until_quantities) {
    const std::string path = measure + ".until." + quantity;
    if (values.given(path) || values.refused(path)) wanted.push_back(quantity);
  }
  if (values.refused(measure + ".until")) return;
  if (values.given(measure + ".until") && wanted.size() != 1) {
    values.report(measure + ".until",
                  "`protocol.measure.until` takes exactly one quantity, such as "
                  "{T_z: 1 %}");
    return;
  }
  const std::string quantity = wanted.empty() ? "T_z" : wanted.front();
  if (quantity == "T_y" && scene.dimension == 2) {
    values.report(measure + ".until.T_y", "T_y is not part of a bed in 2 dimensions (x and z)");
  }
  protocol.until = {quantity, values.number(measure + ".until." + quantity).value_or(0.01)};
}

void read_protocol(SceneValues& values, Scene& scene) {
  auto& protocol = scene.protocol;
  protocol.settle = values.number("protocol.settle");
  protocol.transient = values.integer("protocol.transient.cycles");
  if (values.given("protocol.transient") && !values.refused("protocol.transient") &&
      !values.word("protocol.transient") && !values.given("protocol.transient.cycles")) {
    values.report("protocol.transient", "`protocol.transient` takes auto or {cycles: n}");
  }
  read_measure(values, scene);

  const std::string fraction = "protocol.time_step.fraction_of_contact_duration";
  protocol.time_step_fraction = values.number(fraction).value_or(protocol.time_step_fraction);
  const double coarsest = values.given("container") ? coarse_in_container : coarse_time_step;
  const bool coarse = protocol.time_step_fraction > coarsest;
  const bool allowed = values.boolean("protocol.time_step.allow_coarse").value_or(false);
  if (coarse && !allowed) {
    values.report(fraction, "a time step of " + number_text(protocol.time_step_fraction) +
                                " t_c resolves a contact with fewer than " +
                                number_text(1 / coarsest) + " steps; write at most " +
                                number_text(coarsest) + ", or allow_coarse: true beside it");
  }
  // Said of a fine step the permission changes nothing, so it is not part of the bed.
  protocol.allow_coarse_time_step = coarse;

  const auto engine = values.word("protocol.engine").value_or("auto");
  if (engine == "uniform") protocol.engine = Engine::uniform;
  if (engine == "events") protocol.engine = Engine::events;
  const auto contacts = values.word("protocol.contacts").value_or("auto");
  if (contacts == "fine") protocol.contacts = ContactOperator::fine;
  if (contacts == "closed") protocol.contacts = ContactOperator::closed;

  if (values.word("protocol.profile.frame") == "base") {
    protocol.profile.frame = Scene::ProfileChoice::Frame::base;
  }
  protocol.profile.instant = values.boolean("protocol.profile.instant").value_or(false);
  protocol.profile.phase = values.boolean("protocol.profile.phase").value_or(false);
}

void read_snapshots(SceneValues& values, Scene& scene) {
  const std::string snapshots = "protocol.snapshots";
  auto& wanted = scene.protocol.snapshots;
  wanted.phases = values.numbers(snapshots + ".phases").value_or(std::vector<double>{});
  wanted.cycles = values.integer(snapshots + ".cycles").value_or(1);
  if (values.refused(snapshots + ".phases") || values.refused(snapshots)) return;
  if (values.given(snapshots) && !values.given(snapshots + ".phases")) {
    values.report(snapshots,
                  "`protocol.snapshots` needs `phases`, the instants of a cycle at which the bed "
                  "is kept: {phases: [0, 0.25]}");
  }
  std::sort(wanted.phases.begin(), wanted.phases.end());
  if (std::adjacent_find(wanted.phases.begin(), wanted.phases.end()) != wanted.phases.end()) {
    values.report(snapshots + ".phases", "`protocol.snapshots.phases`: a phase stands there twice");
  }
  if (scene.protocol.cycles && wanted.cycles > *scene.protocol.cycles) {
    values.report(snapshots + ".cycles",
                  "`protocol.snapshots.cycles`: snapshots are taken of measured cycles, of which "
                  "`protocol.measure.cycles` allows " +
                      std::to_string(*scene.protocol.cycles));
  }
}

/// Why k_n is too small, or nothing. Grains that sink half a diameter into each other still have a
/// temperature, of no granular bed; and on the lowest grains of a deep bed rests what is above.
std::string too_soft(const Scene& scene) {
  const double advised = automatic_stiffness(scene);
  const double overlap = expected_largest_overlap(scene, bind_parameters(scene));
  if (overlap > meaningless_overlap) {
    return "overlaps of about " + number_text(std::round(100 * overlap) / 100) +
           " d are to be expected; write at least " + number_text(std::round(advised / 100));
  }
  if (scene.grains.layers > usual_layers && *scene.contact.stiffness < advised / most_softness) {
    return number_text(*scene.contact.stiffness) + " is too soft for " +
           number_text(scene.grains.layers) +
           " layers, whose weight and momentum rest on the lowest grains; write at least " +
           number_text(std::ceil(advised / most_softness));
  }
  return "";
}

void check_softness(SceneValues& values, Scene& scene) {
  if (!scene.contact.stiffness || scene.cell.empty() || scene.grains.count == 0) return;
  const std::string why = too_soft(scene);
  if (!why.empty() && !values.boolean("contact.allow_soft").value_or(false)) {
    values.report("contact.stiffness", "`contact.stiffness`: " + why + " (`auto` would take " +
                                           number_text(std::round(automatic_stiffness(scene))) +
                                           "), or allow_soft: true beside it");
  }
  // Said of hard grains the permission changes nothing, so it is not part of the bed.
  scene.contact.allow_soft = !why.empty();
}

void read_gravity(SceneValues& values, Scene& scene) {
  scene.gravity = values.number("gravity").value_or(1);
  if (scene.gravity == 0 && values.given("container")) {
    values.report("gravity", "`gravity: 0`: a bed in a container, which is open above, needs 1");
    return;
  }
  if (scene.gravity != 0 && scene.gravity != 1) {
    scene.gravity = 1;
    values.report("gravity",
                  "`gravity` is the unit of acceleration: 1, or 0 (a physical g is units.gravity)");
  } else if (scene.gravity == 0 && !values.given("lid")) {
    values.report("gravity",
                  "`gravity: 0` needs a lid, or grains fly away; write lid: {height: 10}");
  }
}

void require_restitution(SceneValues& values) {
  const std::string path = "grains.restitution";
  if (values.given(path) || values.refused(path)) return;
  values.report(path, "the key `" + path +
                          "` is missing (number): " + std::string(find_scene_key(path)->doc));
}

}  // namespace

Scene scene_from(SceneValues& values) {
  Scene scene;
  scene.dimension = static_cast<int>(values.integer("dimension").value_or(3));
  read_gravity(values, scene);
  const auto diameter_mm = diameter_from(values);
  const bool contained = values.given("container");
  if (!contained) {
    refuse_column_keys(values);
    require_restitution(values);
    scene.cell = cell_from(values, diameter_mm);
    check_cell_dimension(values, scene);
    count_and_layers(values, scene);
  }

  scene.grains.restitution = values.number("grains.restitution").value_or(0.9);
  scene.grains.friction = values.number("grains.friction").value_or(0);
  scene.base.restitution = values.number("base.restitution").value_or(scene.grains.restitution);
  scene.base.friction = values.number("base.friction").value_or(scene.grains.friction);
  scene.base.drive =
      drive_from(values, diameter_mm, values.number("units.gravity").value_or(standard_gravity));

  read_walls(values, scene);

  scene.contact.stiffness = values.number("contact.stiffness");
  if (!contained) read_tangential(values, scene);
  read_protocol(values, scene);
  read_snapshots(values, scene);
  check_engine(values, scene);
  if (contained) read_column(values, scene, diameter_mm);
  if (!contained) check_softness(values, scene);
  read_accuracy(values, scene);
  scene.seed = static_cast<std::uint64_t>(values.integer("seed").value_or(1));
  return scene;
}

}  // namespace shakebed::simulator
