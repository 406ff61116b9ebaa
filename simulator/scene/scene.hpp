#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "simulator/contact/spring_kind.hpp"

namespace shakebed::simulator {

/// The base moves as z_b(t) = A sin(omega t).
struct Drive {
  double amplitude = 1;          ///< A [d]
  double angular_frequency = 1;  ///< omega [sqrt(g/d)]

  double peak_velocity() const { return amplitude * angular_frequency; }  ///< V_p [sqrt(g d)]
  double period() const { return 2 * M_PI / angular_frequency; }          ///< [sqrt(d/g)]
};

enum class NormalLaw { linear_spring_dashpot };
enum class TangentialLaw { frictionless, viscous_coulomb };
enum class TangentialDamping { as_normal, critical, value };
enum class Engine { automatic, uniform, events };
/// What the event engine does with a contact: step through it, or take it in one stride when it is
/// provably isolated (automatic: the latter).
enum class ContactOperator { automatic, fine, closed };

/// The direction in which the base moves, and with it all walls that are said to: z (vertical) or
/// x.
enum class DriveDirection { z, x };
enum class OverlapLaw { linear, hertz };
enum class ContainerFrame { lab, co_moving };

/// What a bed in a shaken cylinder has beside, or instead of, what a periodic one has.
struct ColumnScene {
  double diameter = 0;  ///< of the cylinder [d]
  ContainerFrame frame = ContainerFrame::lab;

  double smallest = 1;  ///< small grains have diameters uniform between these [d]
  double largest = 1;
  bool has_large = false;
  double large_diameter = 0;  ///< [d]
  double large_density = 0;   ///< over that of the small grains

  OverlapLaw overlap_law = OverlapLaw::linear;
  SpringKind grain{};                      ///< of contacts between grains
  SpringKind wall{};                       ///< of contacts with base and side wall
  double grain_stiffness_ratio = 2.0 / 7;  ///< k_t/k_n
  double wall_stiffness_ratio = 2.0 / 7;

  double background_damping = 0;      ///< b [m sqrt(g/d)]
  double air_damping = 0;             ///< b against the air [m sqrt(g/d)]
  double air_packing_fraction = 0.6;  ///< phi of the air's closure

  std::optional<double> time_step;  ///< [sqrt(d/g)]; empty: fraction of the shortest t_c
  bool predict_velocities = true;   ///< in contact laws; see ColumnPhysics
  double list_skin = 0.5;           ///< of the list of neighbours [d]; see OuterList

  double prepare_frequency = 1.5;        ///< of the shaking that packs the bed [sqrt(g/d)]
  double prepare_Gamma = 4;              ///< its acceleration [g]
  double prepare_kinetic_energy = 1e-6;  ///< per grain, at which the bed counts as relaxed [m g d]
};

/// One bed as the user asked for it, in reduced units (grain diameter d = 1, grain mass m = 1,
/// time sqrt(d/g)). Reading fills every member; `auto` stays an empty optional.
struct Scene {
  int dimension = 3;   ///< 2 or 3; two dimensions are x and z, and grains are spheres there too
  double gravity = 1;  ///< 1, or 0

  struct Grains {
    int count = 0;
    double layers = 0;  ///< N = count d^2 / (L_x L_y) in 3D, count d / L_x in 2D
    double restitution = 0.9;
    double friction = 0;
  } grains;

  std::vector<double> cell;           ///< periodic lateral widths [d]; dimension - 1 of them
  std::optional<ColumnScene> column;  ///< a cylinder in place of the cell

  struct Base {
    Drive drive;
    double restitution = 0.9;
    double friction = 0;
    DriveDirection direction = DriveDirection::z;
  } base;

  /// A rigid lid; its height is that of its surface above the base's mean height.
  struct Lid {
    double height = 0;            ///< [d]
    bool moves_with_base = true;  ///< else it stands still
    double restitution = 0.9;
    double friction = 0;
  };
  std::optional<Lid> lid;

  /// Rigid walls across x at both ends of the cell, x = 0 and x = L_x, moving with the base.
  struct SideWalls {
    double restitution = 0.9;
    double friction = 0;
  };
  std::optional<SideWalls> side_walls;

  struct Contact {
    NormalLaw normal = NormalLaw::linear_spring_dashpot;
    std::optional<double> stiffness;  ///< k_n [m g/d]; empty: from the overlap target
    bool allow_soft = false;          ///< accept expected overlaps above half a diameter
    TangentialLaw tangential = TangentialLaw::frictionless;
    TangentialDamping damping = TangentialDamping::as_normal;
    double damping_value = 0;  ///< c_t [m sqrt(g/d)] when damping is a number
  } contact;

  struct Precision {
    std::string quantity;  ///< "T_z", ...
    double fraction;       ///< 0.01 for "1 %": standard error over mean
  };

  /// How height profiles are taken (observables/height_profile.hpp).
  struct ProfileChoice {
    enum class Frame { lab, base };
    Frame frame = Frame::lab;
    bool instant = false;  ///< local temperatures of instants beside those over all time
    bool phase = false;    ///< and those about the mean at each phase
  };

  struct Protocol {
    std::optional<double> settle;      ///< time given to settle [sqrt(d/g)]; empty: until at rest
    std::optional<long> transient;     ///< cycles discarded; empty: from W and A/d
    std::optional<long> cycles;        ///< cycles measured ...
    std::optional<Precision> until;    ///< ... or until a quantity is known, with
    long at_most = 20000;              ///< a cap on the cycles measured
    bool cautious_errors = true;       ///< see cautious_mean_of_series()
    double time_step_fraction = 0.02;  ///< dt / t_c
    bool allow_coarse_time_step = false;  ///< accept dt > t_c/5
    Engine engine = Engine::automatic;
    ContactOperator contacts = ContactOperator::automatic;
    ProfileChoice profile;

    /// Snapshots at these phases [cycles, in [0, 1)] of the first measured cycles.
    struct Snapshots {
      std::vector<double> phases;
      long cycles = 1;
      long from_cycle = 0;  ///< in a container: the first cycle that has them
    } snapshots;
  } protocol;

  /// What `accuracy` asked for; the settings it chose stand in protocol and contact.
  struct Accuracy {
    double asked;       ///< 95 % bound on the error of T_z, as a share
    double bias_bound;  ///< of which the settings chosen may take this
  };
  std::optional<Accuracy> accuracy;

  std::uint64_t seed = 1;

  double W() const {  ///< V_p^2/(d g); infinite at g = 0
    const double v = base.drive.peak_velocity();
    return v * v / gravity;
  }
  double Gamma() const {  ///< A omega^2/g; infinite at g = 0
    return base.drive.amplitude * base.drive.angular_frequency * base.drive.angular_frequency /
           gravity;
  }
  /// A bed with walls beside its base is not moved by events.
  bool walled() const { return lid || side_walls; }
  bool any_friction() const {
    return grains.friction > 0 || base.friction > 0 || (lid && lid->friction > 0) ||
           (side_walls && side_walls->friction > 0);
  }
  /// Of grains and base.
  double least_restitution() const { return std::min(grains.restitution, base.restitution); }
  /// Nothing dissipates.
  bool elastic() const {
    return grains.restitution == 1 && base.restitution == 1 && (!lid || lid->restitution == 1) &&
           (!side_walls || side_walls->restitution == 1) && !any_friction();
  }
  /// A base that moves up and down with Gamma < 1 never throws the bed that lies on it.
  bool never_thrown() const {
    return gravity > 0 && base.direction == DriveDirection::z && Gamma() < 1;
  }
  /// Least distance between the base and the lid during a cycle [d]; infinite without a lid.
  double clearance() const {
    if (!lid) return INFINITY;
    const bool narrows = !lid->moves_with_base && base.direction == DriveDirection::z;
    return lid->height - (narrows ? base.drive.amplitude : 0);
  }
  /// How long a grain that leaves the base at V_p flies before it is back [sqrt(d/g)].
  double flight_time() const {
    const double v = base.drive.peak_velocity();
    const double to_lid_and_back = lid ? 2 * lid->height / v : INFINITY;
    return gravity > 0 ? std::min(2 * v / gravity, to_lid_and_back) : to_lid_and_back;
  }
  double cell_area() const {  ///< L_x L_y, or the cylinder's, [d^2] in 3D, L_x [d] in 2D
    if (column) return 0.25 * M_PI * column->diameter * column->diameter;
    double area = 1;
    for (const double width : cell) area *= width;
    return area;
  }
};

}  // namespace shakebed::simulator
