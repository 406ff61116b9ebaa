#include <cmath>
#include <cstdio>
#include <string>

#include "cli/check_accuracy.hpp"
#include "cli/check_column.hpp"
#include "cli/check_lines.hpp"
#include "cli/commands.hpp"
#include "cli/overrides.hpp"
#include "cli/scene_schema.hpp"
#include "files/error.hpp"
#include "simulator/contact/parameters.hpp"
#include "simulator/scene/keys.hpp"
#include "simulator/scene/read_scene.hpp"
#include "simulator/scene/warnings.hpp"
#include "sweeps/cost_model.hpp"

namespace shakebed::cli {

namespace {

using simulator::ContactKind;
using simulator::Parameters;
using simulator::Scene;

/// A guess has no more.
std::string two_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, value < 100 ? "%.2g" : "%.0f", value);
  return text;
}

std::string cell_text(const Scene& scene) {
  std::string text;
  for (const double width : scene.cell) text += (text.empty() ? "" : " x ") + rounded(width);
  return text + " d";
}

void print_walls(const Scene& scene) {
  const auto surface = [](double restitution, double friction) {
    return "; e = " + rounded(restitution) + ", mu = " + rounded(friction);
  };
  if (const auto& lid = scene.lid) {
    line("lid", rounded(lid->height) + " d above the base's mean height, " +
                    (lid->moves_with_base ? "moving with the base" : "fixed") +
                    surface(lid->restitution, lid->friction));
  }
  if (const auto& walls = scene.side_walls) {
    line("side walls", "across x at 0 and " + rounded(scene.cell[0]) + " d, moving with the base" +
                           surface(walls->restitution, walls->friction));
  }
}

void print_bed(const Scene& scene, const Parameters& parameters) {
  const auto& drive = scene.base.drive;
  line("bed", std::to_string(scene.grains.count) +
                  (parameters.turns_grains ? " rough" : " smooth") + " grains in " +
                  std::to_string(scene.dimension) +
                  " dimensions, N = " + rounded(scene.grains.layers) + " layers, " +
                  (scene.side_walls ? "cell " : "periodic cell ") + cell_text(scene));
  print_walls(scene);
  const std::string against_gravity =
      scene.gravity > 0 ? "W = " + rounded(scene.W()) + ", Gamma = " + rounded(scene.Gamma()) + ", "
                        : "no gravity, ";
  const bool sideways = scene.base.direction == simulator::DriveDirection::x;
  line("drive", std::string(sideways ? "along x, " : "") + against_gravity + "A = " +
                    rounded(drive.amplitude) + " d, omega = " + rounded(drive.angular_frequency) +
                    " sqrt(g/d), V_p = " + rounded(drive.peak_velocity()) + " sqrt(g d)");
}

/// What the simulator carries for this scene, and what other scenes would need and this one not.
void print_model(const Scene& scene, const Parameters& parameters) {
  const bool turns = parameters.turns_grains;
  const bool three = scene.dimension == 3;
  const std::string coordinates = three ? "x, y, z" : "x, z";
  line("models", "positions and velocities in " + coordinates +
                     (scene.gravity > 0 ? "; gravity" : "") + "; a vibrating base" +
                     (scene.lid ? "; a lid" : "") + (scene.side_walls ? "; side walls" : ""));
  line("", "linear spring-dashpot along the normal, until the overlap is zero");
  if (turns) {
    line("", three ? "spin about x, y and z; viscous-Coulomb friction in the tangent plane"
                   : "spin about y; viscous-Coulomb friction along the tangent");
  }
  if (!turns) line("leaves out", "spin and any tangential force, as no contact has friction");
  if (!three) line(turns ? "leaves out" : "", "the third coordinate");
  line(turns && three ? "leaves out" : "",
       std::string("memory of contacts, sizes (one diameter), ") +
           (scene.side_walls ? "" : "side walls, ") + (scene.lid ? "" : "lid, ") +
           "air drag, cohesion");
}

void print_contact(const char* name, const ContactKind& kind, bool turns) {
  std::printf("%-13s %-11s %6s %8s %6s %10s %10s %10s %11s\n", "", name,
              rounded(kind.effective_mass).c_str(), rounded(kind.restitution).c_str(),
              turns ? rounded(kind.friction).c_str() : "-", rounded(kind.stiffness).c_str(),
              rounded(kind.normal_damping).c_str(),
              turns ? rounded(kind.tangential_damping).c_str() : "-",
              rounded(kind.contact_duration()).c_str());
}

void print_contacts(const Scene& scene, const Parameters& parameters) {
  std::printf("%-13s %-11s %6s %8s %6s %10s %10s %10s %11s\n", "contacts", "", "m_eff", "e", "mu",
              "k_n", "c_n", "c_t", "t_c");
  print_contact("grain-grain", parameters.grain_grain, parameters.turns_grains);
  print_contact("grain-base", parameters.grain_base, parameters.turns_grains);
  if (scene.lid) print_contact("grain-lid", parameters.grain_lid, parameters.turns_grains);
  if (scene.side_walls) {
    print_contact("grain-side", parameters.grain_side_wall, parameters.turns_grains);
  }
  line("", "m_eff [m], k_n [m g/d], c_n and c_t [m sqrt(g/d)], t_c [sqrt(d/g)]");
}

std::string engine_text(const Scene& scene) {
  const auto& protocol = scene.protocol;
  if (protocol.engine == simulator::Engine::uniform) return "uniform, every grain at every step";
  if (scene.walled()) {
    return "dense, step by step but for grains that fly: the event engine knows no lid and no side "
           "walls";
  }
  const bool fine = protocol.contacts == simulator::ContactOperator::fine;
  return std::string("events, free flights in one stride; contacts ") +
         (fine ? "step by step" : "in closed form where isolated, else step by step");
}

std::string measure_text(const Scene::Protocol& protocol) {
  if (protocol.cycles) return "measure " + std::to_string(*protocol.cycles) + " cycles";
  return "measure until " + protocol.until->quantity + " is known to " +
         rounded(100 * protocol.until->fraction) + " %, at most " +
         std::to_string(protocol.at_most) + " cycles";
}

void print_numerics(const Scene& scene, const Parameters& parameters) {
  const auto& protocol = scene.protocol;
  line("time step", "dt = " + rounded(parameters.time_step) + " sqrt(d/g) = t_c/" +
                        rounded(parameters.contact_duration / parameters.time_step) + ", " +
                        std::to_string(parameters.steps_per_cycle) + " steps per cycle");
  line("engine", engine_text(scene));
  line("stiffness", "omega t_c = " + rounded(drive_angle_in_contact(scene, parameters)) +
                        " rad; largest overlap to expect about " +
                        rounded(expected_largest_overlap(scene, parameters)) +
                        " d (2 V_p sqrt(m/k_n) + N m g/k_n)");
  if (const auto& accuracy = scene.accuracy) {
    line("accuracy", "T_z to " + two_digits(100 * accuracy->asked) + " % (95 %): bias at most " +
                         two_digits(100 * accuracy->bias_bound) +
                         " % by these settings, the rest is noise");
  }
  const long transient = protocol.transient.value_or(simulator::automatic_transient(scene));
  line("protocol", (protocol.settle ? "settle for " + rounded(*protocol.settle) + " sqrt(d/g)"
                                    : std::string("settle until at rest")) +
                       ", discard " + std::to_string(transient) + " cycles, " +
                       measure_text(protocol));
}

void print_scene(const std::string& name, const Scene& scene) {
  const Parameters parameters = bind_parameters(scene);
  line("scene", name + ", seed " + std::to_string(scene.seed));
  print_bed(scene, parameters);
  print_model(scene, parameters);
  print_contacts(scene, parameters);
  print_numerics(scene, parameters);
  line("cost", "about " + two_digits(sweeps::predicted_cpu_seconds(scene)) +
                   " CPU seconds on one core, " + two_digits(sweeps::predicted_cycles(scene)) +
                   " measured cycles (a guess)");
  for (const auto& warning : scene_warnings(scene, parameters)) line("warning", warning);
}

}  // namespace

int check_command(const CheckOptions& options) {
  if (options.keys) {
    std::fputs(simulator::scene_keys_markdown().c_str(), stdout);
  } else if (options.accuracy) {
    std::fputs(accuracy_markdown().c_str(), stdout);
  } else if (options.schema) {
    std::fputs(scene_json_schema().c_str(), stdout);
  } else {
    const auto scene = simulator::read_scene(options.scene, parse_overrides(options.set));
    (scene.column ? print_column_scene : print_scene)(options.scene.string(), scene);
    if (options.csv && !scene.column) {
      throw files::bad_input(options.scene.string(),
                             "--csv writes the contacts of a bed in a container, and this scene "
                             "has none");
    }
    if (options.csv) column_contacts(scene).write(*options.csv);
  }
  return 0;
}

}  // namespace shakebed::cli
