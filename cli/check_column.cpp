#include "cli/check_column.hpp"

#include <cmath>
#include <cstdio>

#include "cli/check_lines.hpp"
#include "simulator/contact/column_parameters.hpp"
#include "simulator/grains/sized_grains.hpp"
#include "simulator/scene/warnings.hpp"
#include "sweeps/cost_model.hpp"

namespace shakebed::cli {
namespace {

using simulator::ColumnScene;
using simulator::Scene;

void print_bed(const Scene& scene) {
  const ColumnScene& column = *scene.column;
  std::string grains = std::to_string(scene.grains.count) + " small grains";
  if (column.smallest < column.largest) {
    grains += " of " + rounded(column.smallest) + " to " + rounded(column.largest) + " d";
  }
  if (column.has_large) {
    grains += " and a large one of " + rounded(column.large_diameter) + " d and " +
              rounded(simulator::sphere_mass(column.large_diameter, column.large_density)) + " m";
  }
  line("bed", grains + " in a cylinder of " + rounded(column.diameter) + " d");
  const auto& drive = scene.base.drive;
  line("drive",
       "Gamma = " + rounded(scene.Gamma()) + ", A = " + rounded(drive.amplitude) +
           " d, omega = " + rounded(drive.angular_frequency) + " sqrt(g/d), V_p = " +
           rounded(drive.peak_velocity()) + " sqrt(g d); base and side wall together" +
           (column.frame == simulator::ContainerFrame::co_moving ? ", in the container's frame"
                                                                 : ""));
}

void print_model(const Scene& scene) {
  const ColumnScene& column = *scene.column;
  const bool hertz = column.overlap_law == simulator::OverlapLaw::hertz;
  line("models", std::string(hertz ? "Hertzian" : "linear") +
                     " springs and dashpots (gamma m_eff v) until the overlap is zero");
  const bool rough = column.grain.friction > 0;
  const bool rough_wall = column.wall.friction > 0;
  if (rough) line("", "Cundall-Strack springs with memory between grains");
  if (rough_wall) line("", "Cundall-Strack springs with memory at base and side wall");
  if (rough || rough_wall) line("", "spins");
  if (column.background_damping > 0) {
    line("", "background drag, b = " + rounded(column.background_damping) + " m sqrt(g/d)");
  }
  if (column.air_damping > 0) {
    line("", "air drag on the slip, b = " + rounded(column.air_damping) + " m sqrt(g/d)");
  }
  if (!rough) line("leaves out", "memory and friction of contacts between grains");
  if (!rough_wall) line(rough ? "leaves out" : "", "memory and friction at base and side wall");
}

void print_contacts(const simulator::ColumnParameters& parameters) {
  std::printf("%-13s %-11s %8s %8s %6s %10s %10s %8s %8s %11s\n", "contacts", "", "m_eff", "e",
              "mu", "k_n", "k_t", "gamma_n", "gamma_t", "t_c");
  for (const auto& kind : parameters.kinds) {
    std::printf(
        "%-13s %-11s %8s %8s %6s %10s %10s %8s %8s %11s\n", "", kind.name.c_str(),
        rounded(kind.effective_mass).c_str(), rounded(kind.restitution).c_str(),
        rounded(kind.spring.friction).c_str(), rounded(kind.spring.normal_stiffness).c_str(),
        rounded(kind.spring.tangential_stiffness).c_str(), rounded(kind.spring.normal_rate).c_str(),
        rounded(kind.spring.tangential_rate).c_str(), rounded(kind.contact_duration).c_str());
  }
  line("", "m_eff [m], k_n and k_t [m g/d], gamma [sqrt(g/d)], t_c [sqrt(d/g)]");
}

}  // namespace

files::CsvTable column_contacts(const Scene& scene) {
  const auto parameters = simulator::bind_column(scene);
  files::CsvTable table({{"contact", ""},
                         {"m_eff", "m"},
                         {"restitution", "1"},
                         {"friction", "1"},
                         {"k_n", "m g/d"},
                         {"k_t", "m g/d"},
                         {"gamma_n", "sqrt(g/d)"},
                         {"gamma_t", "sqrt(g/d)"},
                         {"t_c", "sqrt(d/g)"},
                         {"steps_in_t_c", "1"}});
  for (const auto& kind : parameters.kinds) {
    const auto& spring = kind.spring;
    std::vector<std::string> cells{kind.name};
    for (const double value :
         {kind.effective_mass, kind.restitution, spring.friction, spring.normal_stiffness,
          spring.tangential_stiffness, spring.normal_rate, spring.tangential_rate,
          kind.contact_duration, kind.contact_duration / parameters.time_step}) {
      cells.push_back(std::isfinite(value) ? files::number_text(value) : "");
    }
    table.add_row(std::move(cells));
  }
  return table;
}

void print_column_scene(const std::string& name, const Scene& scene) {
  const auto parameters = simulator::bind_column(scene);
  line("scene", name + ", seed " + std::to_string(scene.seed));
  print_bed(scene);
  print_model(scene);
  print_contacts(parameters);
  line("time step", "dt = " + rounded(parameters.time_step) + " sqrt(d/g) = t_c/" +
                        rounded(parameters.contact_duration / parameters.time_step) + ", " +
                        std::to_string(parameters.steps_per_cycle) + " steps per cycle");
  line("protocol",
       "pack and relax, then " + std::to_string(scene.protocol.cycles.value_or(1)) + " cycles");
  line("cost", "about " + rounded(std::round(sweeps::predicted_cpu_seconds(scene))) +
                   " CPU seconds on one core (a guess)");
  for (const auto& warning : simulator::column_warnings(parameters)) line("warning", warning);
}

}  // namespace shakebed::cli
