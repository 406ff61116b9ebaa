#include "cli/lammps_column_deck.hpp"

#include <algorithm>
#include <numbers>
#include <sstream>

#include "files/build_info.hpp"
#include "files/csv.hpp"
#include "files/error.hpp"
#include "simulator/column_preparation.hpp"

namespace shakebed::cli {
namespace {

using files::number_text;
using simulator::ColumnScene;
using simulator::Scene;
using simulator::SpringKind;

constexpr long phases = 20;      // of each cycle that are written
constexpr double relaxing = 20;  // with friction [sqrt(d/g)]

void refuse_what_lammps_lacks(const ColumnScene& column, const std::string& name) {
  if (column.overlap_law == simulator::OverlapLaw::hertz) {
    throw files::bad_input(name,
                           "has Hertzian contacts, whose factor in LAMMPS is sqrt(delta R_eff) and "
                           "not sqrt(delta/d); decks are written for linear_spring_dashpot");
  }
  if (column.air_damping > 0) {
    throw files::bad_input(name, "has drag.air, which LAMMPS does not know; set it to 0");
  }
}

/// Kn Kt gamma_n gamma_t xmu dampflag.
std::string contact_words(const SpringKind& kind, double friction) {
  return number_text(kind.normal_stiffness) + " " + number_text(kind.tangential_stiffness) + " " +
         number_text(kind.normal_rate) + " " + number_text(kind.tangential_rate) + " " +
         number_text(friction) + " 1";
}

void write_head(std::ostream& deck, const std::string& name) {
  deck << "# LAMMPS input deck of the scene " << name << ", written by shakebed "
       << files::version() << R"(.
#
# Run:      lmp -in THIS_FILE        Results go to the file `out`.
# Change:   lmp -in THIS_FILE -var cycles 5 -var out other.txt
# Units:    small grain's diameter d = 1 and mass m = 1, gravity g = 1.
# Contact:  gran/hooke/history: F_n = k_n delta - gamma_n m_eff v_n, a tangential spring cut off at
#           xmu |F_n|. Walls are grains of infinite mass.
# Start:    ours only in the parameters: grains fall without friction and relax with it (and with a
#           drag), the base at its lowest, where LAMMPS' walls begin their stroke. shakebed packs by
#           shaking and begins at mid-stroke.
# Time:     T counts cycles from the first instant at which the base passes z = 0 upwards, a quarter
#           of a cycle after the stroke begins: shakebed's T.
# Columns:  T, then heights [d] and velocities [sqrt(g d)] in the laboratory, and 2 contacts/grains.
)";
}

void write_variables(std::ostream& deck, const Scene& scene, double settling) {
  const auto p = simulator::bind_column(scene);
  deck << "\nvariable cycles index " << scene.protocol.cycles.value_or(1)
       << "\nvariable out index lammps_column.txt\nvariable skin index 0.5\n"
       << "variable amplitude index " << number_text(scene.base.drive.amplitude)
       << "\nvariable period index " << number_text(scene.base.drive.period())
       << "\nvariable steps_per_cycle index " << p.steps_per_cycle
       << "  # t_c = " << number_text(p.contact_duration) << "\nvariable settling index "
       << number_text(settling) << "\nvariable relaxing index " << number_text(relaxing) << R"(
variable lowest equal -v_amplitude
variable dt equal v_period/v_steps_per_cycle
variable stride equal v_steps_per_cycle/)"
       << phases << R"(
variable settle_steps equal ceil(v_settling/v_dt)
variable relax_steps equal ceil(v_relaxing/v_dt)
variable shake_steps equal (v_cycles+0.25)*v_steps_per_cycle
)";
}

void write_grains(std::ostream& deck, const Scene& scene, const simulator::SizedGrains& grains) {
  const ColumnScene& column = *scene.column;
  const double lowest = -scene.base.drive.amplitude;
  const double R = 0.5 * column.diameter;
  const auto& z = grains.position[2];
  const double top = lowest + *std::max_element(z.begin(), z.end()) + 2;
  const std::string wide = number_text(-R - 1) + " " + number_text(R + 1);
  deck << "\nunits lj\nboundary f f fs\nnewton off\natom_style sphere\natom_modify map "
          "array\ncomm_modify vel yes\n"
       << "region cell block " << wide << " " << wide << " " << number_text(lowest - 1) << " "
       << number_text(top) << " units box\ncreate_box 1 cell\n";
  for (std::size_t i = 0; i < grains.count(); ++i) {
    deck << "create_atoms 1 single " << number_text(grains.position[0][i]) << " "
         << number_text(grains.position[1][i]) << " " << number_text(z[i] + lowest)
         << " units box\n";
  }
  for (std::size_t i = 0; i < grains.count(); ++i) {
    const double d = 2 * grains.radius[i];
    deck << "set atom " << i + 1 << " diameter " << number_text(d) << " density "
         << number_text(grains.mass[i] / (std::numbers::pi / 6 * d * d * d)) << "\n";
  }
  deck << (column.has_large ? "group large id 1\n" : "group large empty\n")
       << "group small subtract all large\n";
}

void write_walls(std::ostream& deck, const ColumnScene& column, double friction,
                 const std::string& moving) {
  const std::string words = contact_words(column.wall, friction);
  deck << "fix base all wall/gran hooke/history " << words << " zplane ${lowest} NULL" << moving
       << "\nfix side all wall/gran hooke/history " << words << " zcylinder "
       << number_text(0.5 * column.diameter) << moving << "\n";
}

void write_motion(std::ostream& deck, const Scene& scene) {
  const ColumnScene& column = *scene.column;
  const auto pair = [&](double friction) {
    deck << "pair_style gran/hooke/history " << contact_words(column.grain, friction)
         << "\npair_coeff * *\n";
  };
  deck << "\nneighbor ${skin} bin\nneigh_modify every 1 delay 0 check yes\ntimestep ${dt}\n"
          "fix weight all gravity 1 vector 0 0 -1\nfix move all nve/sphere\n"
          "thermo ${steps_per_cycle}\nthermo_style custom step atoms ke\n\n"
          "# Falling without friction, then relaxing with it.\nfix cool all viscous 0.5\n";
  pair(0);
  write_walls(deck, column, 0, "");
  deck << "run ${settle_steps}\nunfix base\nunfix side\n";
  pair(column.grain.friction);
  write_walls(deck, column, column.wall.friction, "");
  deck
      << "run ${relax_steps}\nunfix base\nunfix side\nunfix cool\nreset_timestep 0\n\n# Shaking.\n";
  if (column.background_damping > 0) {
    deck << "fix drag all viscous " << number_text(column.background_damping) << "\n";
  }
  write_walls(deck, column, column.wall.friction, " wiggle z ${amplitude} ${period}");
}

void write_output(std::ostream& deck, const ColumnScene& column) {
  deck << R"(compute touching all contact/atom
compute Z all reduce ave c_touching
variable T equal step/v_steps_per_cycle-0.25
variable base equal -v_amplitude*cos(2*PI*step/v_steps_per_cycle)
variable small_z equal xcm(small,z)
variable small_v equal vcm(small,z)
variable coordination equal c_Z
)";
  std::string names = "T base_height small_height small_velocity coordination";
  std::string values = "${T} ${base} ${small_z} ${small_v} ${coordination}";
  if (column.has_large) {
    deck << "variable large_z equal z[1]\nvariable large_v equal vz[1]\n";
    names += " large_height large_velocity";
    values += " ${large_z} ${large_v}";
  }
  deck << "thermo_style custom step atoms ke c_Z\nfix write all print ${stride} \"" << values
       << "\" file ${out} screen no title \"# " << names << "\"\nrun ${shake_steps}\n";
}

}  // namespace

std::string lammps_column_deck(const Scene& scene, const std::string& name) {
  const ColumnScene& column = *scene.column;
  refuse_what_lammps_lacks(column, name);
  const auto grains = simulator::fill_column(simulator::contents_of(scene), scene.seed);
  const auto& z = grains.position[2];
  // A fall from the top, with the drag, and some more.
  const double settling = 20 + *std::max_element(z.begin(), z.end());
  std::ostringstream deck;
  write_head(deck, name);
  write_variables(deck, scene, settling);
  write_grains(deck, scene, grains);
  write_motion(deck, scene);
  write_output(deck, column);
  return deck.str();
}

}  // namespace shakebed::cli
