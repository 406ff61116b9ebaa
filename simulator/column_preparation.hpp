#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "simulator/column_pouring.hpp"

namespace shakebed::simulator {

/// A bed from the store, or made and put there. The name says all that the bed depends on.
template <class Make>
PreparedBed stored_bed(const std::string& name, const RunControl& control, const Make& make) {
  PreparedBed bed;
  if (control.store != nullptr) {
    if (const auto bytes = control.store->load(name)) {
      ByteReader reader(*bytes, "prepared bed");
      bed.archive(reader);
      reader.finish();
      return bed;
    }
  }
  bed = make();
  if (control.store != nullptr) {
    ByteWriter writer;
    bed.archive(writer);
    control.store->save(name, std::move(writer).take());
  }
  return bed;
}

/// Packs a bed as Sun 2006 does: the large grain is held at the bottom, small grains rain on it
/// while the container is shaken fast and gently, until the height of the centre of mass is steady;
/// then the shaking stops, the large grain is let go, and the bed relaxes until its kinetic energy
/// is below the scene's bound.
///
/// Ours, as the paper does not say: friction is off until the bed has calmed down (Pouring), since
/// blows would wedge grains between the walls for good, with forces a hundred times the bed's
/// weight; and while it relaxes, gamma_t = 40 sqrt(g/d) ends what springs that stick would swing
/// for ever (at rest it has no force).
template <class Physics>
class Preparation {
 public:
  Preparation(const Scene& scene, const RunControl& control)
      : control_(control), scene_(scene), packing_(packing_scene(scene)) {}

  PreparedBed make() {
    PreparedBed bed = stored_bed(name_of("poured bed", pouring_text(scene_)), control_, [&] {
      return Pouring<typename Physics::Overlap>(packing_, control_).make();
    });
    relax(bed);
    bed.height = height_of(bed.grains);
    return bed;
  }

  static std::string name_of(const std::string& what, const std::string& text) {
    return what + ", physics version " + std::to_string(physics_version) + "\n" + text;
  }

 private:
  void relax(PreparedBed& bed) {
    auto still = bind_packing_at_rest<Physics>(packing_);
    add_dashpot(still.grain_grain);
    add_dashpot(still.grain_wall);
    if (scene_.column->has_large) set_row(bed.grains.velocity, 0, Vector<3>(0, 0, 0));
    ColumnStepper<Physics> mover(still, bed.grains, 0, {}, -1, control_.crew);
    bed.relaxed_for +=
        bring_to_rest(mover, still.time_step, scene_.column->prepare_kinetic_energy, control_);
    bed.grains = mover.synchronised();
    bed.kinetic_energy = bed.grains.kinetic_energy() / static_cast<double>(bed.grains.count());
    for (const auto& c : mover.contacts()) bed.memory.push_back({c.i, c.j, c.memory});
  }

  template <class Contact>
  static void add_dashpot(Contact& contact) {
    SpringKind kind = contact.kind;
    kind.tangential_rate = std::max(kind.tangential_rate, 40.0);
    contact = Contact(kind);
  }

  static double height_of(const SizedGrains& grains) {
    std::vector<double> tops;
    for (std::size_t i = 0; i < grains.count(); ++i) {
      tops.push_back(grains.position[2][i] + grains.radius[i]);
    }
    const auto place =
        tops.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(tops.size() - 1));
    std::nth_element(tops.begin(), place, tops.end());
    return *place;
  }

  const RunControl& control_;
  const Scene& scene_;
  Scene packing_;
};

/// The scene's prepared bed: from the store, or made and put there.
template <class Physics>
PreparedBed prepared_bed(const Scene& scene, const RunControl& control) {
  const auto name = Preparation<Physics>::name_of("prepared bed", preparation_text(scene));
  return stored_bed(name, control, [&] { return Preparation<Physics>(scene, control).make(); });
}

}  // namespace shakebed::simulator
