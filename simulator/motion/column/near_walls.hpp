#pragma once

#include <algorithm>
#include <type_traits>
#include <vector>

#include "simulator/motion/column/contact_list.hpp"
#include "simulator/motion/column/physics.hpp"
#include "simulator/motion/column/promise.hpp"
#include "simulator/motion/column/wall_list.hpp"

namespace shakebed::simulator {

/// Which rows can touch base or side wall before the window's end.
template <class Physics>
class NearWalls {
 public:
  static constexpr bool walls_remember =
      !std::is_empty_v<typename Physics::template WallMemory<double>>;

  struct NearWall {
    WallList<walls_remember> list;
    std::vector<long> stamp;  ///< window in which the row was last listed

    template <class Archive>
    void archive(Archive& a) {
      list.archive(a);
      a(stamp);
    }
  };

  /// What is left of the window, and what rows promise for it.
  struct Outlook {
    double left;
    const std::vector<Promise>& promises;
  };

  NearWall base;
  NearWall side;

  void resize_to(std::size_t n) {
    base.stamp.assign(n, -1);
    side.stamp.assign(n, -1);
  }

  bool listed(std::uint32_t i, long window) const {
    return base.stamp[i] == window || side.stamp[i] == window;
  }

  void recall(const RowStore& rows, std::uint32_t i, const ContactMemory& one) {
    auto& wall = one.j == base_partner ? base : side;
    wall.list.push(i, rows.radius[i], rows.mass[i], one.u);
  }

  void rename(const std::vector<std::uint32_t>& new_row) {
    for (auto* wall : {&base, &side}) {
      for (std::size_t k = 0; k < wall->list.size; ++k) {
        wall->list.row[k] = new_row[wall->list.row[k]];
      }
    }
  }

  /// Lists anew: those whose contact remembers, then all others within reach.
  void relist(const RowStore& rows, const Physics& physics, const BaseState& now, long window,
              const Outlook& outlook) {
    keep_remembering(base, window);
    keep_remembering(side, window);
    for (std::uint32_t i = 0; i < rows.count(); ++i) list(rows, i, physics, now, window, outlook);
  }

  /// Lists row i under the walls that it can reach, the base being as it is `now`.
  void list(const RowStore& rows, std::uint32_t i, const Physics& physics, const BaseState& now,
            long window, const Outlook& outlook) {
    const auto& x = rows.seen[i].position;
    const auto& v = rows.own[i].half_velocity;
    const double left = outlook.left;
    const double width = static_cast<double>(outlook.promises[i][3]);
    const double off = (width + physics.largest_field() * left) * left;
    const double nearing = std::max(now.velocity - v[2], 0.0) * left;
    if (x[2] - rows.radius[i] - now.height < nearing + off) enter(base, rows, i, window);
    // The distance from the axis is largest at an end of a straight line.
    const Four end = x + left * v;
    const double square = std::max(x[0] * x[0] + x[1] * x[1], end[0] * end[0] + end[1] * end[1]);
    const double inside = physics.cylinder.radius - rows.radius[i] - off;
    if (inside < 0 || square > inside * inside) enter(side, rows, i, window);
  }

  template <class Archive>
  void archive(Archive& a) {
    base.archive(a);
    side.archive(a);
  }

 private:
  static void enter(NearWall& wall, const RowStore& rows, std::uint32_t i, long window) {
    if (wall.stamp[i] == window) return;
    wall.stamp[i] = window;
    wall.list.push(i, rows.radius[i], rows.mass[i], {0, 0, 0});
  }

  static void keep_remembering(NearWall& wall, long window) {
    const auto old = wall.list;
    wall.list.clear();
    for (std::size_t k = 0; k < old.size; ++k) {
      const auto u = old.memory_at(k);
      if (u.x == 0 && u.y == 0 && u.z == 0) continue;
      wall.stamp[old.row[k]] = window;
      wall.list.push(old.row[k], old.radius[k], old.mass[k], u);
    }
  }
};

}  // namespace shakebed::simulator
