#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "simulator/contact/chosen.hpp"
#include "simulator/motion/grid_row.hpp"
#include "simulator/motion/listed_pairs.hpp"
#include "simulator/motion/transposes.hpp"

// Contacts of rows in SIMD vectors: rows are gathered and transposed, the law is evaluated for all
// lanes at once, and forces are added row by row in the order of the list. Each contact gets the
// very numbers it would get alone, however wide the vectors are.
namespace shakebed::simulator {

/// Rows of numbers are read and written in parts of two or four.
template <std::size_t width>
using RowPart = std::conditional_t<(width > 2), Four, Two>;

template <class Part>
[[gnu::always_inline]] inline Part load_part(const double* from) {
  Part part;
  std::memcpy(&part, from, sizeof part);
  return part;
}

/// One contact in each lane.
template <class Physics>
struct ContactVector {
  static constexpr int D = Physics::dimension;
  static constexpr int S = Physics::GrainState::spin_columns;
  using Row = GridRow<Physics>;
  using Place = RowPart<Row::room>;
  using Part = RowPart<Row::width>;
  static constexpr std::size_t part_size = sizeof(Part) / sizeof(double);
  static constexpr std::size_t parts = Row::width / part_size;  ///< of a row of rates
  using Rates = Part[parts][lane_count];

  Vector<D, Lanes> normal;  ///< from i to j
  Lanes overlap;
  Lanes motion[Row::width];  ///< v_i - v_j, then omega_i + omega_j, in a row's places
  Lanes change[Row::width];  ///< accelerations of i, linear and angular
  Lanes dissipated_power;

  [[gnu::always_inline]] void gather_pairs(const Row* rows, const ListedPair<D>* pairs) {
    Rates rates;
    Place apart[lane_count];
    for (std::size_t q = 0; q < lane_count; ++q) {
      const Row& a = row_at(rows, pairs[q].at_i);
      const Row& b = row_at(rows, pairs[q].at_j);
      for (std::size_t p = 0; p < parts; ++p) {
        rates[p][q] = with_reaction(p, load_part<Part>(a.predicted.data() + p * part_size),
                                    load_part<Part>(b.predicted.data() + p * part_size));
      }
      apart[q] = separation_of(a, b, pairs[q]);
    }
    set_motion(rates);
    normal = vectors_of(apart);
    const Lanes distance = std::experimental::sqrt(normal.squaredNorm());
    normal *= Lanes(1.0) / distance;
    overlap = 2 * grain_radius - distance;
  }

  /// Squares of the distances from i to the image of j that is meant.
  [[gnu::always_inline]] static Lanes squared_distances(const Row* rows,
                                                        const ListedPair<D>* pairs) {
    Place apart[lane_count];
    for (std::size_t q = 0; q < lane_count; ++q) {
      apart[q] = separation_of(row_at(rows, pairs[q].at_i), row_at(rows, pairs[q].at_j), pairs[q]);
    }
    return vectors_of(apart).squaredNorm();
  }

  [[gnu::always_inline]] void set_motion(const Rates& rates) {
    for (std::size_t p = 0; p < parts; ++p) transpose_rows(rates[p], motion + p * part_size);
  }

  template <class Law>
  [[gnu::always_inline]] void evaluate(const Law& law) {
    Vector<D, Lanes> v;
    Spin<D, Lanes> spin_radius = Spin<D, Lanes>::Constant(Lanes(0));
    for (int c = 0; c < D; ++c) v[c] = motion[c];
    for (int c = 0; c < S; ++c) spin_radius[c] = grain_radius * motion[Row::spin_first + c];
    const auto f = law.template operator()<Lanes>(normal, overlap, v, spin_radius);
    std::fill_n(change, Row::width, Lanes(0.0));
    for (int c = 0; c < D; ++c) change[c] = f.force[c];
    for (int c = 0; c < S; ++c) {
      change[Row::spin_first + c] = (grain_radius / grain_inertia) * f.moment_per_radius[c];
    }
    dissipated_power = f.dissipated_power;
  }

  /// Leaves out lanes that do not touch.
  [[gnu::always_inline]] void mask(const LaneMask& touching) {
    const Lanes none(0.0);
    for (auto& lanes : change) lanes = chosen(touching, lanes, none);
    dissipated_power = chosen(touching, dissipated_power, none);
    overlap = chosen(touching, overlap, none);
  }

  /// Adds the changes to the rows of i, and what follows of them to those of j.
  [[gnu::always_inline]] void scatter_pairs(Row* rows, const ListedPair<D>* pairs) const {
    Rates rates;
    get_changes(rates);
    for (std::size_t q = 0; q < lane_count; ++q) {
      Row& a = row_at(rows, pairs[q].at_i);
      Row& b = row_at(rows, pairs[q].at_j);
      for (std::size_t p = 0; p < parts; ++p) add(a, p, rates[p][q]);
      for (std::size_t p = 0; p < parts; ++p) {
        const Part sum =
            with_reaction(p, load_part<Part>(b.change.data() + p * part_size), rates[p][q]);
        std::memcpy(b.change.data() + p * part_size, &sum, sizeof sum);
      }
    }
  }

  [[gnu::always_inline]] void get_changes(Rates& rates) const {
    for (std::size_t p = 0; p < parts; ++p) transpose_lanes(change + p * part_size, rates[p]);
  }
  [[gnu::always_inline]] static void add(Row& row, std::size_t p, const Part& part) {
    const Part sum = load_part<Part>(row.change.data() + p * part_size) + part;
    std::memcpy(row.change.data() + p * part_size, &sum, sizeof sum);
  }

 private:
  [[gnu::always_inline]] static Vector<D, Lanes> vectors_of(const Place* places) {
    Lanes columns[sizeof(Place) / sizeof(double)];
    transpose_rows(places, columns);
    Vector<D, Lanes> v;
    for (int c = 0; c < D; ++c) v[c] = columns[c];
    return v;
  }

  [[gnu::always_inline]] static Place separation_of(const Row& a, const Row& b,
                                                    const ListedPair<D>& pair) {
    Place shift{};
    for (int c = 0; c < Dimension<D>::lateral; ++c) shift[c] = pair.shift[c];
    return load_part<Place>(b.x.data()) - load_part<Place>(a.x.data()) + shift;
  }

  /// a - b of velocities, and of forces on i and j; a + b of spins and of moments, which act on
  /// both alike.
  [[gnu::always_inline]] static Part with_reaction(std::size_t p, const Part& a, const Part& b) {
    const std::size_t first = p * part_size;
    if (first + part_size <= Row::spin_first) return a - b;
    if (first >= Row::spin_first) return a + b;
    Part signs;
    for (std::size_t c = 0; c < part_size; ++c) signs[c] = c < Row::spin_first ? -1.0 : 1.0;
    return a + signs * b;
  }
};

}  // namespace shakebed::simulator
