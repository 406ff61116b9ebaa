#include "tests/networks/packing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <unordered_map>

namespace shakebed::tests {

using fitting::networks::ContactRow;
using fitting::networks::distance;
using fitting::networks::GrainRow;
using fitting::networks::Point;

namespace {

struct Grains {
  std::vector<Point> position;
  std::vector<double> radius;
  double cylinder_radius;
  double height;
};

/// Calls visit(i, j) for i < j whose centres may be closer than `reach`, and for all pairs with
/// the large grain (number 0, when it is larger than that).
void near_pairs(const Grains& grains, double reach, const auto& visit) {
  std::unordered_map<std::int64_t, std::vector<std::size_t>> cells;
  const auto cell = [&](const Point& p, int dx, int dy, int dz) {
    const auto x = static_cast<std::int64_t>(std::floor(p[0] / reach)) + dx + 4096;
    const auto y = static_cast<std::int64_t>(std::floor(p[1] / reach)) + dy + 4096;
    const auto z = static_cast<std::int64_t>(std::floor(p[2] / reach)) + dz + 4096;
    return (x << 40) + (y << 20) + z;
  };
  const bool large = grains.radius[0] > 0.6;
  for (std::size_t i = large ? 1 : 0; i < grains.position.size(); ++i) {
    cells[cell(grains.position[i], 0, 0, 0)].push_back(i);
    if (large) visit(0, i);
  }
  for (std::size_t i = large ? 1 : 0; i < grains.position.size(); ++i) {
    for (int n = 0; n < 27; ++n) {
      const auto found = cells.find(cell(grains.position[i], n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
      if (found == cells.end()) continue;
      for (const std::size_t j : found->second) {
        if (i < j) visit(i, j);
      }
    }
  }
}

double overlap(const Grains& grains, std::size_t i, std::size_t j) {
  return grains.radius[i] + grains.radius[j] - distance(grains.position[i], grains.position[j]);
}

void keep_inside(Grains& grains) {
  for (std::size_t i = 0; i < grains.position.size(); ++i) {
    Point& p = grains.position[i];
    const double most = grains.cylinder_radius - grains.radius[i];
    const double off_axis = std::hypot(p[0], p[1]);
    if (off_axis > most) {
      p[0] *= most / off_axis;
      p[1] *= most / off_axis;
    }
    p[2] = std::clamp(p[2], grains.radius[i], grains.height - grains.radius[i]);
  }
}

void push_apart(Grains& grains) {
  std::vector<Point> shift(grains.position.size(), Point{});
  near_pairs(grains, 1.0, [&](std::size_t i, std::size_t j) {
    const double depth = overlap(grains, i, j);
    if (depth <= 0) return;
    const double apart = distance(grains.position[i], grains.position[j]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double half =
          0.3 * depth * (grains.position[i][axis] - grains.position[j][axis]) / apart;
      shift[i][axis] += half;
      shift[j][axis] -= half;
    }
  });
  for (std::size_t i = 0; i < grains.position.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) grains.position[i][axis] += shift[i][axis];
  }
  keep_inside(grains);
}

Grains strewn(const PackingOptions& options, Random& random) {
  Grains grains;
  grains.cylinder_radius = options.cylinder_diameter / 2;
  const double volume = static_cast<double>(options.small_grains) * std::numbers::pi / 6 +
                        (options.large_grain ? std::numbers::pi / 6 * std::pow(3.16, 3) : 0);
  grains.height = volume / options.solid_fraction /
                  (std::numbers::pi * grains.cylinder_radius * grains.cylinder_radius);
  if (options.large_grain) {
    grains.position.push_back({0.3, -0.2, 5});
    grains.radius.push_back(1.58);
  }
  while (grains.position.size() < options.small_grains + (options.large_grain ? 1 : 0)) {
    const double angle = 2 * std::numbers::pi * uniform(random);
    const double r = grains.cylinder_radius * std::sqrt(uniform(random));
    grains.position.push_back(
        {r * std::cos(angle), r * std::sin(angle), grains.height * uniform(random)});
    grains.radius.push_back(0.5);
  }
  keep_inside(grains);
  return grains;
}

struct Touch {
  std::size_t i, j;
  double depth;
};

std::vector<ContactRow> contacts_with_forces(const Grains& grains, Random& random) {
  std::vector<Touch> touching;
  near_pairs(grains, 1.0, [&](std::size_t i, std::size_t j) {
    const double depth = overlap(grains, i, j);
    if (depth > 0) touching.push_back({i, j, depth});
  });
  std::ranges::sort(touching, {}, [](const Touch& t) { return std::tuple(t.depth, t.i, t.j); });
  auto forces = draw(fitting::networks::normalised(0.68, 1.35), touching.size(), random);
  std::ranges::sort(forces);
  std::vector<ContactRow> rows;
  for (std::size_t k = 0; k < touching.size(); ++k) {
    rows.push_back({static_cast<std::int64_t>(touching[k].i),
                    static_cast<std::int64_t>(touching[k].j), 12.5 * forces[k]});
  }
  return rows;
}

}  // namespace

std::vector<double> draw(const fitting::networks::ForceLaw& law, std::size_t count,
                         Random& random) {
  std::vector<double> forces;
  while (forces.size() < count) {
    const double f = -std::log(uniform(random)) / law.beta;
    const double x = f - law.theta;
    if (uniform(random) < 1 - law.b * std::exp(-x * x)) forces.push_back(f);
  }
  return forces;
}

fitting::networks::Snapshot packing(const PackingOptions& options, std::uint64_t seed) {
  Random random(seed);
  Grains grains = strewn(options, random);
  for (int sweep = 0; sweep < options.sweeps; ++sweep) push_apart(grains);
  const auto contacts = contacts_with_forces(grains, random);
  std::vector<GrainRow> rows;
  for (std::size_t i = 0; i < grains.position.size(); ++i) {
    rows.push_back({static_cast<std::int64_t>(i), grains.position[i], grains.radius[i]});
  }
  for (std::size_t k = 0; k < options.flying; ++k) {
    const double height = grains.height + 30 + 7.5 * static_cast<double>(k) * uniform(random);
    rows.push_back({static_cast<std::int64_t>(rows.size()), {uniform(random), 0.1, height}, 0.5});
  }
  const auto place = [](std::size_t row) { return "row " + std::to_string(row); };
  return fitting::networks::assemble("packing", rows, place, contacts, place);
}

}  // namespace shakebed::tests
