#include "files/csv.hpp"
#include "simulator/grains/filling.hpp"
#include "simulator/scene/admissible.hpp"

namespace shakebed::simulator {

namespace {

using files::number_text;

/// A lid must leave room for the bed as it is poured (filling.hpp), at every phase.
void check_clearance(SceneValues& values, const Scene& scene) {
  if (!values.number("lid.height") || scene.cell.empty()) return;
  const double needed = filled_height(static_cast<std::size_t>(scene.grains.count), scene.cell);
  if (scene.clearance() >= needed) return;
  values.report(
      "lid.height",
      "`lid.height`: " + std::to_string(scene.grains.count) + " grains in this cell need " +
          number_text(needed) + " d between base and lid, which leave " +
          number_text(scene.clearance()) + " d" +
          (scene.clearance() < scene.lid->height ? " when the base is highest below the fixed lid"
                                                 : "") +
          "; raise the lid or take fewer grains");
}

}  // namespace

void read_walls(SceneValues& values, Scene& scene) {
  if (values.given("lid")) {
    auto& lid = scene.lid.emplace();
    lid.height = values.number("lid.height").value_or(0);
    lid.moves_with_base = values.word("lid.moves").value_or("with_base") == "with_base";
    lid.restitution = values.number("lid.restitution").value_or(scene.base.restitution);
    lid.friction = values.number("lid.friction").value_or(scene.base.friction);
    if (!values.given("lid.height") && !values.refused("lid.height")) {
      values.report("lid", "`lid` needs `height`, above the base's mean height: {height: 10}");
    }
    check_clearance(values, scene);
  }
  if (values.given("side_walls")) {
    auto& walls = scene.side_walls.emplace();
    walls.restitution = values.number("side_walls.restitution").value_or(scene.base.restitution);
    walls.friction = values.number("side_walls.friction").value_or(scene.base.friction);
    if (!values.given("side_walls.across") && !values.refused("side_walls.across")) {
      values.report("side_walls", "`side_walls` needs `across`, their normal: {across: x}");
    }
  }
  if (values.word("base.moves_along") == "x") {
    scene.base.direction = DriveDirection::x;
    if (!values.given("side_walls")) {
      values.report("base.moves_along",
                    "`base.moves_along: x` needs walls that push the grains; write side_walls: "
                    "{across: x}");
    }
  }
}

void check_engine(SceneValues& values, const Scene& scene) {
  if (!scene.walled() || scene.protocol.engine != Engine::events) return;
  values.report("protocol.engine",
                "`protocol.engine: events` does not know a lid or side walls; write auto or "
                "uniform");
}

}  // namespace shakebed::simulator
