#include "cli/lammps_deck.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <vector>

#include "files/build_info.hpp"
#include "files/csv.hpp"
#include "files/error.hpp"
#include "simulator/contact/parameters.hpp"
#include "simulator/grains/filling.hpp"

namespace shakebed::cli {
namespace {

using files::number_text;
using simulator::ContactKind;
using simulator::Parameters;
using simulator::Scene;

constexpr double coarsest_step = 1.0 / 75;  // of t_c, see the header
constexpr double settling_time = 10;        // sqrt(d/g); the lattice's gaps are about 0.1 d

/// Words that differ between two dimensions (LAMMPS has x and y there) and three.
struct Axes {
  std::array<const char*, 3> lateral_and_up;  ///< LAMMPS' names of our x, (y,) z
  const char* up;
  const char* gravity;
  const char* boundary;
};

Axes axes_of(const Scene& scene) {
  // The upper face is shrink-wrapped ("fs"): grains may fly to any height.
  if (scene.dimension == 2) return {{"x", "y", ""}, "y", "0 -1 0", "p fs p"};
  return {{"x", "y", "z"}, "z", "0 0 -1", "p p fs"};
}

std::vector<std::string> temperatures(const Scene& scene) {
  if (scene.dimension == 2) return {"T_x", "T_z"};
  return {"T_x", "T_y", "T_z"};
}

std::vector<std::string> columns(const Scene& scene) {
  auto names = temperatures(scene);
  names.insert(names.end(), {"T", "h_cm"});
  return names;
}

long measured_cycles(const Scene& scene) {
  return scene.protocol.cycles.value_or(scene.protocol.at_most);
}

/// Kn Kt gamma_n gamma_t xmu dampflag.
std::string contact_words(const ContactKind& kind, bool turns_grains) {
  const double rough = turns_grains ? 1 : 0;
  return number_text(kind.stiffness) + " 0 " +
         number_text(kind.normal_damping / kind.effective_mass) + " " +
         number_text(rough * kind.tangential_damping / kind.effective_mass) + " " +
         number_text(rough * kind.friction) + " 1";
}

void write_head(std::ostream& deck, const Scene& scene, const Parameters& scene_step,
                const std::string& name) {
  deck << "# LAMMPS input deck of the scene " << name << ", written by shakebed "
       << files::version() << R"(.
#
# Run:      lmp -in THIS_FILE
# Change:   lmp -in THIS_FILE -var cycles 1000 -var out other.txt
#           (any of the index variables below). Results go to the file `out`.
#
# Units:    grain diameter d = 1, grain mass m = 1, gravity g = 1.
# Grains:   spheres of inertia (2/5) m R^2)"
       << (scene.dimension == 2 ? ", also here in two dimensions, where LAMMPS' y is the\n"
                                  "#           vertical, our z"
                                : "")
       << R"(.
# Contact:  gran/hooke, F_n = k_n delta - gamma_n m_eff v_n, F_t = min(gamma_t m_eff v_t, xmu F_n).
#           gamma = c/m_eff, with m_eff = 1/2 between grains and 1 at the base; Kt is not used.
# Base:     LAMMPS moves a wall as lo + A - A cos(omega t), from the step at which it is made;
#           shakebed moves it as A sin(omega t). With lo = -A these are equal a quarter cycle
#           later. The grains settle for 3/4 of a cycle more than a whole number of cycles, so
#           that at steps divisible by steps_per_cycle the base is at z = 0 and moves up: every
#           average is over one cycle of shakebed's.
# Sampling: at 64 equal phases a cycle; T_x ... = (m/2) <(v - <v>)^2> [m g d], <.> over grains at
#           one instant; h_cm [d] above the base's mean height. One line a cycle.
# Time:     LAMMPS takes damping and friction at velocities half a step late, which lowers T_z by
#           about 1.6 % at dt = t_c/25 and in proportion. Hence t_c/75 or finer here; the scene's
#           own step is -var steps_per_cycle )"
       << scene_step.steps_per_cycle << ".\n";
  if (scene.protocol.until) {
    deck << "# Length:   the scene measures until " << scene.protocol.until->quantity
         << " is known, which LAMMPS cannot; cycles below is\n"
            "#           the scene's at_most. Set another number by -var cycles N.\n";
  }
}

void write_variables(std::ostream& deck, const Scene& scene, const Parameters& p) {
  const auto& drive = scene.base.drive;
  const double settle = scene.protocol.settle.value_or(settling_time);
  const long transient = scene.protocol.transient.value_or(automatic_transient(scene));
  deck << "\nvariable steps_per_cycle index " << p.steps_per_cycle
       << "  # a multiple of 64; t_c = " << number_text(p.contact_duration)
       << "\nvariable settle_cycles index "
       << std::max(1L, std::lround(std::ceil(settle / drive.period())))
       << "\nvariable transient_cycles index " << transient << "\nvariable cycles index "
       << measured_cycles(scene) << "\nvariable out index lammps_averages.txt"
       << "\nvariable skin index 0.5\n\n"
       << "variable amplitude index " << number_text(drive.amplitude) << "\nvariable period index "
       << number_text(drive.period()) << "\nvariable grains index " << scene.grains.count << R"(
variable lowest equal -v_amplitude
variable stride equal v_steps_per_cycle/64
variable settle_steps equal (v_settle_cycles+0.75)*v_steps_per_cycle
variable transient_steps equal (v_transient_cycles+0.25)*v_steps_per_cycle
variable measured_steps equal v_cycles*v_steps_per_cycle
variable first equal step+v_steps_per_cycle
)";
}

template <int D>
void write_lattice(std::ostream& deck, const Scene& scene) {
  simulator::PeriodicCell<D> cell{};
  std::copy(scene.cell.begin(), scene.cell.end(), cell.width.begin());
  const auto count = static_cast<std::size_t>(scene.grains.count);
  const auto grains = simulator::fill<D, false>(count, cell, scene.seed);
  const double lowest = -scene.base.drive.amplitude;
  const auto& heights = grains.position[D - 1];
  const double top = lowest + *std::max_element(heights.begin(), heights.end()) + 1;

  const std::string up = number_text(lowest - 1) + " " + number_text(top);
  deck << "\nregion cell block 0 " << number_text(scene.cell[0]);
  if constexpr (D == 2) {
    deck << " " << up << " -0.5 0.5";
  } else {
    deck << " 0 " << number_text(scene.cell[1]) << " " << up;
  }
  deck << " units box\ncreate_box 1 cell\n";
  for (std::size_t i = 0; i < count; ++i) {
    deck << "create_atoms 1 single";
    for (int c = 0; c < D; ++c) {
      deck << " " << number_text(grains.position[c][i] + (c == D - 1 ? lowest : 0));
    }
    deck << (D == 2 ? " 0" : "") << " units box\n";
  }
  deck << R"(variable density equal 6/PI
set group all diameter 1 density ${density}
variable mass equal mass(all)
variable faulty equal "atoms != v_grains || abs(v_mass/v_grains-1) > 1e-9"
if "${faulty}" then 'print "ERROR: the deck made ${mass} grain masses, not ${grains}"' 'quit 1'
)";
}

void write_physics(std::ostream& deck, const Scene& scene, const Parameters& p) {
  const auto axes = axes_of(scene);
  const std::string wall = "fix base all wall/gran hooke " +
                           contact_words(p.grain_base, p.turns_grains) + " " + axes.up +
                           "plane ${lowest} NULL";
  deck << "\npair_style gran/hooke " << contact_words(p.grain_grain, p.turns_grains) << R"(
pair_coeff * *
neighbor ${skin} bin
neigh_modify every 1 delay 0 check yes

variable dt equal v_period/v_steps_per_cycle
timestep ${dt}
fix weight all gravity )"
       << number_text(scene.gravity) << " vector " << axes.gravity << "\nfix move all nve/sphere\n"
       << (scene.dimension == 2 ? "fix plane all enforce2d\n" : "")
       << "thermo ${steps_per_cycle}\nthermo_style custom step atoms ke\n\n"
       << "# Settling on the still base, hastened by a drag.\nfix cool all viscous 0.5\n"
       << wall << "\nrun ${settle_steps}\nunfix cool\nunfix base\n\n"
       << wall << " wiggle " << axes.up << " ${amplitude} ${period}\nrun ${transient_steps}\n";
}

void write_measurement(std::ostream& deck, const Scene& scene) {
  const auto axes = axes_of(scene);
  const auto names = columns(scene);
  const int D = scene.dimension;
  deck << "\n";
  std::string moments;
  std::string squares;
  std::string total;
  for (int c = 0; c < D; ++c) {
    const std::string axis = axes.lateral_and_up[c];
    deck << "variable square_" << axis << " atom v" << axis << "*v" << axis << "\n";
    moments += " v" + axis;
    squares += " v_square_" + axis;
  }
  deck << "compute moments all reduce ave" << moments << squares << " " << axes.up << "\n";
  for (int c = 0; c < D; ++c) {
    deck << "variable " << names[c] << " equal 0.5*(c_moments[" << D + c + 1 << "]-c_moments["
         << c + 1 << "]^2)\n";
    total += (c ? "+v_" : "v_") + names[c];
  }
  deck << "variable T equal (" << total << ")/" << D << "\nvariable h_cm equal c_moments["
       << 2 * D + 1 << "]\n";

  std::string variables;
  std::string cycle;
  std::string title = "# step";
  for (std::size_t k = 0; k < names.size(); ++k) {
    variables += " v_" + names[k];
    cycle += " f_cycle[" + std::to_string(k + 1) + "]";
    title += " " + names[k];
  }
  deck << "fix cycle all ave/time ${stride} 64 ${steps_per_cycle}" << variables
       << " file ${out} format \" %.12g\" title1 \"# averages over one cycle each\" title2 \""
       << title << "\"\n"
       << "fix mean all ave/time ${steps_per_cycle} 1 ${steps_per_cycle}" << cycle
       << " ave running start ${first}\n\nrun ${measured_steps}\n\n"
       << "print \"Means over ${cycles} cycles:\"\n";
  for (std::size_t k = 0; k < names.size(); ++k) {
    deck << "variable mean_" << names[k] << " equal f_mean[" << k + 1 << "]\n"
         << "print \"  " << names[k] << " = ${mean_" << names[k] << "}\"\n";
  }
}

}  // namespace

std::string lammps_deck(const Scene& scene, const std::string& name) {
  if (scene.walled()) {
    throw files::bad_input(name,
                           "has a lid or side walls, which the deck does not describe; only "
                           "`shakebed run` simulates it");
  }
  Scene finer = scene;
  finer.protocol.time_step_fraction = std::min(scene.protocol.time_step_fraction, coarsest_step);
  const Parameters p = bind_parameters(finer);

  std::ostringstream deck;
  write_head(deck, scene, bind_parameters(scene), name);
  write_variables(deck, scene, p);
  deck << "\nunits lj\ndimension " << scene.dimension << "\nboundary " << axes_of(scene).boundary
       << "\natom_style sphere\ncomm_modify vel yes\n";
  scene.dimension == 2 ? write_lattice<2>(deck, scene) : write_lattice<3>(deck, scene);
  write_physics(deck, scene, p);
  write_measurement(deck, scene);
  return deck.str();
}

}  // namespace shakebed::cli
