#include "simulator/scene/keys.hpp"

#include <algorithm>
#include <cmath>

#include "files/csv.hpp"

namespace shakebed::simulator {

namespace {

using enum KeyType;

constexpr double unlimited = std::numeric_limits<double>::infinity();

constexpr Range any_value{};
constexpr Range positive{0, unlimited, true, false};
constexpr Range not_negative{0, unlimited, false, false};
constexpr Range open_to_one{0, 1, true, false};

constexpr Range from_to(double low, double high) { return {low, high, false, false}; }
constexpr Range above_up_to(double low, double high) { return {low, high, true, false}; }

const std::vector<Key>& table() {
  // clang-format off
  static const std::vector<Key> keys{
      {"scene", integer, "", any_value, {}, true, "",
       "schema of this file: 1"},
      {"dimension", integer, "1", from_to(2, 3), {}, true, "",
       "2 (x and z; grains are spheres there too) or 3"},
      {"gravity", number, "g", from_to(0, 1), {}, false, "1",
       "1 by the choice of units; 0 needs a lid (then `W`, `Gamma` and physical frequencies of the drive "
       "still mean the unit g)"},

      {"grains.count", integer, "1", from_to(1, 1e6), {}, false, "this or layers",
       "grain count"},
      {"grains.layers", number, "1", above_up_to(0, 1e4), {}, false, "this or count",
       "N = count d^2/(L_x L_y) in 3D, count d/L_x in 2D; must come to a whole grain count"},
      {"grains.restitution", number, "1", open_to_one, {}, false,
       "required, but in a container, which has contact.gamma_n",
       "normal restitution coefficient e_p between grains (e = 0 would take infinite damping)"},
      {"grains.friction", number, "1", from_to(0, 100), {}, false, "0",
       "friction coefficient mu_p between grains"},
      {"grains.diameter_mm", number, "mm", positive, {}, false, "units.diameter",
       "the grain diameter d, which turns keys with physical units into reduced ones"},

      {"grains.sizes", numbers, "d", from_to(0.5, 1.5), {}, false, "[1, 1]",
       "diameters of the small grains, uniform between [smallest, largest]; in a container"},
      {"grains.large.diameter", number, "d", from_to(1.6, 20), {}, false, "no large grain",
       "diameter of one large grain, which begins at the bottom, on the axis; in a container"},
      {"grains.large.diameter_mm", number, "mm", positive, {}, false, "this or diameter",
       "the same in mm; needs the grain diameter"},
      {"grains.large.density", number, "m/d^3", positive, {}, false, "this or density_ratio",
       "mass of the large grain over its volume (a small grain has 6/pi)"},
      {"grains.large.density_ratio", number, "1", positive, {}, false, "1",
       "the same over that of the small grains"},

      {"container.cylinder.diameter", number, "d", from_to(2, 1e3), {}, false, "this or cell",
       "an upright cylinder in place of the periodic cell, open above; its side wall is shaken with "
       "the base"},
      {"container.cylinder.diameter_mm", number, "mm", positive, {}, false, "this or diameter",
       "the same in mm; needs the grain diameter"},
      {"container.frame", word, "", any_value, {"lab", "co_moving"}, false, "lab",
       "co_moving: the container rests and gravity is g + d^2 z_b/dt^2; the same motion"},
      {"container.wall.friction", number, "1", from_to(0, 100), {}, false, "as grains.friction",
       "friction coefficient mu_wall of base and side wall"},
      {"container.wall.stiffness", number, "m g/d", from_to(1, 1e15), {}, false,
       "as contact.stiffness", "k_n of contacts with base and side wall"},
      {"container.wall.stiffness_ratio", number, "1", positive, {}, false,
       "as contact.tangential.stiffness_ratio", "k_t/k_n of contacts with base and side wall"},
      {"container.wall.gamma_n", number, "sqrt(g/d)", not_negative, {}, false,
       "as contact.gamma_n", "normal damping of contacts with base and side wall"},
      {"container.wall.gamma_t", number, "sqrt(g/d)", not_negative, {}, false,
       "as contact.tangential.gamma_t", "tangential damping of contacts with base and side wall"},

      {"cell", numbers, "d", from_to(2.2, 1e4), {}, false, "this or cell_mm",
       "lateral widths: [L_x, L_y] in 3D, [L_x] in 2D; periodic unless there are side walls (below "
       "2.2 d a grain would meet another one and its image at once)"},
      {"cell_mm", numbers, "mm", positive, {}, false, "this or cell",
       "the same in mm; needs the grain diameter"},

      {"base.drive.W", number, "1", positive, {}, false, "two of drive.*",
       "V_p^2/(d g) with V_p = A omega; the base moves as z_b = A sin(omega t)"},
      {"base.drive.Gamma", number, "1", positive, {}, false, "two of drive.*",
       "A omega^2/g"},
      {"base.drive.frequency", number, "sqrt(g/d)", positive, {}, false, "two of drive.*",
       "f = omega/(2 pi)"},
      {"base.drive.angular_frequency", number, "sqrt(g/d)", positive, {}, false, "two of drive.*",
       "omega"},
      {"base.drive.frequency_rpm", number, "1/min", positive, {}, false, "two of drive.*",
       "f in cycles per minute; needs the grain diameter"},
      {"base.drive.frequency_hz", number, "1/s", positive, {}, false, "two of drive.*",
       "f in cycles per second; needs the grain diameter"},
      {"base.drive.amplitude", number, "d", positive, {}, false, "two of drive.*",
       "A"},
      {"base.drive.amplitude_mm", number, "mm", positive, {}, false, "two of drive.*",
       "A in mm; needs the grain diameter"},
      {"base.restitution", number, "1", open_to_one, {}, false, "as grains.restitution",
       "normal restitution coefficient e_w of the base"},
      {"base.friction", number, "1", from_to(0, 100), {}, false, "as grains.friction",
       "friction coefficient of the base"},

      {"base.moves_along", word, "", any_value, {"z", "x"}, false, "z",
       "direction of the drive; x needs side_walls"},

      {"lid.height", number, "d", above_up_to(0, 1e5), {}, false, "no lid",
       "of the lid's lower surface above the base's mean height"},
      {"lid.moves", word, "", any_value, {"with_base", "fixed"}, false, "with_base",
       "with_base: at a constant height above the base; fixed: it stands still"},
      {"lid.restitution", number, "1", open_to_one, {}, false, "as base.restitution",
       "normal restitution coefficient of the lid"},
      {"lid.friction", number, "1", from_to(0, 100), {}, false, "as base.friction",
       "friction coefficient of the lid"},
      {"side_walls.across", word, "", any_value, {"x"}, false, "no side walls",
       "rigid walls at both ends of the cell in this direction, moving with the base: x = 0 and "
       "x = L_x"},
      {"side_walls.restitution", number, "1", open_to_one, {}, false, "as base.restitution",
       "normal restitution coefficient of the side walls"},
      {"side_walls.friction", number, "1", from_to(0, 100), {}, false, "as base.friction",
       "friction coefficient of the side walls"},

      {"contact.normal", word, "", any_value, {"linear_spring_dashpot", "hertz"}, false,
       "linear_spring_dashpot",
       "F_n = k_n delta + c_n v_n with closing speed v_n, until the overlap is zero; hertz (in a "
       "container): this times sqrt(delta/(a_i + a_j)), tangential forces as well"},
      {"contact.gamma_n", number, "sqrt(g/d)", not_negative, {}, false, "required in a container",
       "normal damping: F_n = k_n delta - gamma_n m_eff v_n; in a container"},
      {"contact.stiffness", number, "m g/d", from_to(1, 1e15), {"auto"}, false, "auto",
       "k_n of every contact; auto: 2e4 max(1, N/4) max(m V_p^2/min(A, d)^2, m g/d), for overlaps "
       "of about 1 % of d"},
      {"contact.allow_soft", boolean, "", any_value, {}, false, "false",
       "accept a k_n so small that overlaps of half a diameter are to be expected, where "
       "temperatures look plausible and mean nothing, or under a quarter of `auto` for more than "
       "four layers"},
      {"contact.tangential", word, "", any_value, {"frictionless"}, false,
       "viscous_coulomb with damping c_n if any friction is set, else frictionless",
       "frictionless, or a map with the keys below"},
      {"contact.tangential.law", word, "", any_value,
       {"viscous_coulomb", "cundall_strack", "frictionless"}, false, "needed in the map",
       "viscous_coulomb: F_t = min(c_t v_t, mu F_n) against the slip velocity; cundall_strack (in "
       "a container): a spring with memory, cut off at mu F_n"},
      {"contact.tangential.stiffness_ratio", number, "1", positive, {}, false, "2/7",
       "k_t/k_n of cundall_strack"},
      {"contact.tangential.gamma_t", number, "sqrt(g/d)", not_negative, {}, false, "0",
       "tangential damping of cundall_strack: F_t = -k_t u - gamma_t m_eff v_t"},
      {"contact.tangential.damping", number, "m sqrt(g/d)", not_negative, {"c_n", "critical"},
       false, "c_n",
       "c_t: a number, or c_n (each contact kind's own c_n), or critical (2 sqrt(k_n m_eff))"},

      {"drag.background", number, "m sqrt(g/d)", not_negative, {}, false, "0",
       "b of a drag -b v on every grain; in a container"},
      {"drag.air", number, "m sqrt(g/d)", not_negative, {}, false, "0",
       "b of a drag on the slip (v - v_container)/(1 - phi) against the air; in a container"},
      {"drag.air_packing_fraction", number, "1", from_to(0, 0.75), {}, false, "0.6",
       "phi, for the whole bed"},

      {"accuracy", word, "", any_value, {"draft", "standard", "reference"}, false,
       "as the protocol says",
       "time step, k_n (unless given) and measuring rule from the measured trade of accuracy against "
       "time; a word, or a map with the key below"},
      {"accuracy.T_z", percent, "%", above_up_to(0, 50), {}, false, "",
       "95 % bound on the whole error of T_z, bias and noise; the cheapest settings are taken"},

      {"protocol.prepare.frequency", number, "sqrt(g/d)", positive, {}, false, "1.5",
       "of the shaking that packs a bed in a container before the run"},
      {"protocol.prepare.Gamma", number, "1", positive, {}, false, "4",
       "A omega^2/g of that shaking"},
      {"protocol.prepare.kinetic_energy", number, "m g d", positive, {}, false, "1e-6",
       "per grain; below it the packed bed counts as relaxed"},
      {"protocol.settle", number, "sqrt(d/g)", not_negative, {"auto"}, false, "auto",
       "time for the grains to come to rest before the base moves; auto: until they are"},
      {"protocol.transient", word, "", any_value, {"auto"}, false, "auto",
       "auto: several flights of the bed are let pass; or {cycles: n}"},
      {"protocol.transient.cycles", integer, "cycles", from_to(0, 1e9), {}, false, "auto",
       "cycles discarded before measuring"},
      {"protocol.measure.cycles", integer, "cycles", from_to(1, 1e9), {}, false, "this or until",
       "cycles measured"},
      {"protocol.measure.until.T_z", percent, "%", above_up_to(0, 50), {}, false, "1 %",
       "measure until the standard error of T_z is this share of its mean"},
      {"protocol.measure.until.T_x", percent, "%", above_up_to(0, 50), {}, false, "",
       "the same for T_x, in place of T_z"},
      {"protocol.measure.until.T_y", percent, "%", above_up_to(0, 50), {}, false, "",
       "the same for T_y (3D), in place of T_z"},
      {"protocol.measure.until.T", percent, "%", above_up_to(0, 50), {}, false, "",
       "the same for T, in place of T_z"},
      {"protocol.measure.at_most", integer, "cycles", from_to(1, 1e9), {}, false, "20000",
       "cap on the cycles measured with until"},
      {"protocol.measure.errors", word, "", any_value, {"cautious", "window"}, false, "cautious",
       "standard errors from an automatic window over the correlation function: the largest of "
       "those at coarser and coarser entries, which slow modes do not fool; or that of the cycles "
       "alone, as in tables of before"},
      {"protocol.time_step.fraction_of_contact_duration", number, "t_c", from_to(1e-4, 0.5), {},
       false, "0.02",
       "dt over the shortest contact duration t_c; above 0.1 a warning is given"},
      {"protocol.time_step.allow_coarse", boolean, "", any_value, {}, false, "false",
       "accept dt above 0.2 t_c, where restitution is visibly off"},
      {"protocol.time_step.value", number, "sqrt(d/g)", positive, {}, false,
       "fraction_of_contact_duration",
       "dt itself, in a container; the nearest that gives 160 equal phases a cycle is taken"},
      {"protocol.contact_velocities", word, "", any_value, {"predicted", "half_step"}, false,
       "predicted",
       "velocities in contact laws, in a container: at the time of the positions, or half a step "
       "late as LAMMPS has them"},
      {"protocol.list_skin", number, "d", from_to(0.05, 5), {}, false, "0.5",
       "how far beyond touch the list of neighbours reaches, in a container: a matter of cost, no "
       "contact is missed with any"},
      {"protocol.engine", word, "", any_value, {"auto", "uniform", "events"}, false, "auto",
       "uniform: velocity Verlet with one step for all; events (and auto): free flights are skipped"},
      {"protocol.contacts", word, "", any_value, {"auto", "fine", "closed"}, false, "auto",
       "of the event engine: fine steps through every contact; closed (and auto) takes isolated "
       "ones in one stride by their exact solution"},
      {"protocol.profile.frame", word, "", any_value, {"lab", "base"}, false, "lab",
       "heights and velocities of profiles: in the lab, or relative to the base"},
      {"protocol.profile.instant", boolean, "", any_value, {}, false, "false",
       "beside local temperatures about a box's mean velocity over all time also those about its "
       "mean at each instant, where a box with fewer than two grains counts as cold"},
      {"protocol.profile.phase", boolean, "", any_value, {}, false, "false",
       "and those about its mean at each of 16 phases of the cycle: without the motion that the "
       "drive repeats"},
      {"protocol.snapshots.phases", numbers, "cycles", Range{0, 1, false, true}, {}, false, "none",
       "phases of the drive at which positions, velocities and contacts are kept; at 0 the base "
       "passes its mean height upwards; [] for none (a container's default is 20 of cycle 10)"},
      {"protocol.snapshots.from_cycle", integer, "cycles", from_to(0, 1e9), {}, false, "10",
       "in a container: the first cycle that has snapshots"},
      {"protocol.snapshots.cycles", integer, "cycles", from_to(1, 1e4), {}, false, "1",
       "how many of the first measured cycles have snapshots"},

      {"seed", integer, "1", not_negative, {}, false, "1",
       "of the start positions and velocities; another seed is another replicate"},

      {"units.diameter", quantity, "mm", positive, {}, false, "",
       "the grain diameter d in m, cm, mm or um; needed by keys with a physical unit"},
      {"units.density", quantity, "kg/m3", positive, {}, false, "",
       "of the grains' material in kg/m3 or g/cm3; no reduced result depends on it"},
      {"units.gravity", quantity, "m/s2", positive, {}, false, "9.81 m/s2",
       "g in m/s2 or cm/s2; needed by physical frequencies"},
  };
  // clang-format on
  return keys;
}

}  // namespace

bool Range::contains(double value) const {
  const bool above = low_open ? value > low : value >= low;
  const bool below = high_open ? value < high : value <= high;
  return above && below;
}

bool Range::bounded() const { return std::isfinite(low) || std::isfinite(high); }

std::string Range::text() const {
  if (!bounded()) return "";
  if (!std::isfinite(high)) return (low_open ? "> " : ">= ") + files::number_text(low);
  if (!std::isfinite(low)) return (high_open ? "< " : "<= ") + files::number_text(high);
  return (low_open ? "(" : "[") + files::number_text(low) + ", " + files::number_text(high) +
         (high_open ? ")" : "]");
}

const std::vector<Key>& scene_keys() { return table(); }

const Key* find_scene_key(std::string_view path) {
  const auto& keys = table();
  const auto key =
      std::find_if(keys.begin(), keys.end(), [&](const Key& one) { return one.path == path; });
  return key == keys.end() ? nullptr : &*key;
}

std::vector<std::string> scene_keys_under(std::string_view path) {
  const std::string prefix = path.empty() ? "" : std::string(path) + ".";
  std::vector<std::string> names;
  for (const Key& key : table()) {
    if (!key.path.starts_with(prefix)) continue;
    const std::string_view rest = key.path.substr(prefix.size());
    const std::string name(rest.substr(0, rest.find('.')));
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

const std::vector<UnitSize>& unit_sizes() {
  static const std::vector<UnitSize> sizes{
      {"mm", "mm", 1},       {"m", "mm", 1e-3},        {"cm", "mm", 0.1},   {"um", "mm", 1000},
      {"kg/m3", "kg/m3", 1}, {"g/cm3", "kg/m3", 1e-3}, {"m/s2", "m/s2", 1}, {"cm/s2", "m/s2", 100},
  };
  return sizes;
}

std::string type_text(const Key& key) {
  std::string text;
  const auto add = [&text](std::string_view more) {
    if (!text.empty()) text += " or ";
    text += more;
  };
  switch (key.type) {
    case integer:
      add("whole number");
      break;
    case number:
      add("number");
      break;
    case boolean:
      add("true or false");
      break;
    case numbers:
      add("list of numbers");
      break;
    case percent:
      add("percentage such as 1 %");
      break;
    case quantity:
      add("quantity such as 5 " + std::string(key.unit));
      break;
    case word:
      break;
  }
  for (const auto one : key.words) add(one);
  return text;
}

std::string scene_keys_markdown() {
  std::string text =
      "| key | value | unit | range | default | meaning |\n|---|---|---|---|---|---|\n";
  for (const Key& key : table()) {
    text += "| `" + std::string(key.path) + "` | " + type_text(key) + " | " +
            std::string(key.unit) + " | " + key.range.text() + " | " +
            (key.required ? "required" : std::string(key.fallback)) + " | " + std::string(key.doc) +
            " |\n";
  }
  return text;
}

}  // namespace shakebed::simulator
