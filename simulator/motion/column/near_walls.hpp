#pragma once

#include <algorithm>
#include <type_traits>
#include <vector>

#include "simulator/motion/column/contact_list.hpp"
#include "simulator/motion/column/physics.hpp"
#include "simulator/motion/column/promise.hpp"
#include "simulator/motion/column/wall_list.hpp"

namespace shakebed::simulator {

/// Which rows of a block can touch base or side wall before the window's end.
template <class Physics>
class NearWalls {
 public:
  static constexpr bool walls_remember =
      !std::is_empty_v<typename Physics::template WallMemory<double>>;

  struct NearWall {
    WallList<walls_remember> list;
    std::vector<long> stamp;  ///< window in which the block's row was last listed

    template <class Archive>
    void archive(Archive& a) {
      list.archive(a);
      a(stamp);
    }
  };

  /// What is left of the window, and what rows promise for it.
  struct Outlook {
    double left;
    const Promises& promises;
  };

  NearWall base;
  NearWall side;

  /// Row `padding` lies far from every wall.
  void take_rows(std::uint32_t begin, std::uint32_t end, std::uint32_t padding) {
    base.list.fill_up_with(padding);
    side.list.fill_up_with(padding);
    begin_ = begin;
    end_ = end;
    base.stamp.assign(end - begin, -1);
    side.stamp.assign(end - begin, -1);
  }

  bool listed(std::uint32_t i, long window) const {
    return base.stamp[i - begin_] == window || side.stamp[i - begin_] == window;
  }

  void recall(const RowStore& rows, std::uint32_t i, std::int32_t partner,
              const Triple<double>& u) {
    auto& wall = partner == base_partner ? base : side;
    wall.list.push(i, rows.radius[i], rows.mass[i], u);
  }

  /// Empties the lists; `keep(row, partner, u)` is given what contacts remember.
  template <class Keep>
  void give_up(Keep keep) {
    for (const std::int32_t partner : {base_partner, side_partner}) {
      auto& list = (partner == base_partner ? base : side).list;
      for (std::size_t k = 0; k < list.size; ++k) {
        const auto u = list.memory_at(k);
        if (remembers(u)) keep(list.row[k], partner, u);
      }
      list.clear();
    }
  }

  /// Lists anew: those whose contact remembers, then all others within reach.
  void relist(const RowStore& rows, const Physics& physics, const BaseState& now, long window,
              const Outlook& outlook) {
    keep_remembering(base, window);
    keep_remembering(side, window);
    for (std::uint32_t i = begin_; i < end_; ++i) list(rows, i, physics, now, window, outlook);
  }

  /// Lists row i under the walls that it can reach, the base being as it is `now`.
  void list(const RowStore& rows, std::uint32_t i, const Physics& physics, const BaseState& now,
            long window, const Outlook& outlook) {
    const auto& x = rows.position[i];
    const auto& v = rows.own[i].half_velocity;
    const double left = outlook.left;
    const double width = outlook.promises.width(i);
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
  static bool remembers(const Triple<double>& u) { return u.x != 0 || u.y != 0 || u.z != 0; }

  void enter(NearWall& wall, const RowStore& rows, std::uint32_t i, long window) const {
    if (wall.stamp[i - begin_] == window) return;
    wall.stamp[i - begin_] = window;
    wall.list.push(i, rows.radius[i], rows.mass[i], {0, 0, 0});
  }

  void keep_remembering(NearWall& wall, long window) const {
    const auto old = wall.list;
    wall.list.clear();
    for (std::size_t k = 0; k < old.size; ++k) {
      const auto u = old.memory_at(k);
      if (!remembers(u)) continue;
      wall.stamp[old.row[k] - begin_] = window;
      wall.list.push(old.row[k], old.radius[k], old.mass[k], u);
    }
  }

  std::uint32_t begin_ = 0;
  std::uint32_t end_ = 0;
};

}  // namespace shakebed::simulator
