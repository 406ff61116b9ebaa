#pragma once

#include <algorithm>
#include <experimental/simd>

#include "simulator/contact/chosen.hpp"
#include "simulator/motion/column/contacts_of.hpp"
#include "simulator/motion/column/pair_list.hpp"
#include "simulator/motion/column/row_store.hpp"
#include "simulator/motion/column/wall_list.hpp"

// Contacts in SIMD vectors: rows are gathered and transposed, the law is evaluated for all lanes at
// once, and forces are added row by row in the order of the list, so that sums do not depend on the
// width of the vectors.
namespace shakebed::simulator {

/// The memory of `lane_count` contacts that begin at `k`, or nothing.
template <class Memory, class List>
[[gnu::always_inline]] inline Memory load_memory(List& columns, std::size_t k) {
  if constexpr (std::is_empty_v<Memory>) {
    return {};
  } else {
    return {load_lanes(&columns[0][k]), load_lanes(&columns[1][k]), load_lanes(&columns[2][k])};
  }
}

template <class Memory, class List>
[[gnu::always_inline]] inline void store_memory(List& columns, std::size_t k, const Memory& u,
                                                const LaneMask& touching) {
  if constexpr (!std::is_empty_v<Memory>) {
    using std::experimental::element_aligned;
    const Lanes none(0.0);
    chosen(touching, u.x, none).copy_to(&columns[0][k], element_aligned);
    chosen(touching, u.y, none).copy_to(&columns[1][k], element_aligned);
    chosen(touching, u.z, none).copy_to(&columns[2][k], element_aligned);
  }
}

[[gnu::always_inline]] inline LaneTriple chosen(const LaneMask& mask, const LaneTriple& a) {
  const Lanes none(0.0);
  return {chosen(mask, a.x, none), chosen(mask, a.y, none), chosen(mask, a.z, none)};
}

[[gnu::always_inline]] inline std::size_t touching_count(const LaneMask& mask) {
  return static_cast<std::size_t>(std::experimental::popcount(mask));
}

/// What one pass over contacts found.
struct PassResult {
  long touching = 0;
  Lanes largest_overlap{0.0};

  [[gnu::always_inline]] void count(const LaneMask& mask, const Lanes& overlap) {
    touching += static_cast<long>(touching_count(mask));
    std::experimental::where(overlap > largest_overlap, largest_overlap) = overlap;
  }
};

/// Relative motion of the vector of pairs that begins at `k`.
template <class Law, class List>
[[gnu::always_inline]] inline void gather_pairs(const RowStore& rows, const List& list,
                                                std::size_t k, ContactState<Lanes>& c) {
  using Vectors = RowVectors<Law::turns_grains>;
  using Part = typename Vectors::Part;
  const std::uint32_t* i = list.i() + k;
  const std::uint32_t* j = list.j() + k;
  const Four* place = rows.position.data();
  const MotionRow* motion = rows.motion.data();
  Four x[lane_count];
  typename Vectors::Parts relative;
  for (std::size_t q = 0; q < lane_count; ++q) {
    x[q] = place[i[q]] - place[j[q]];
    for (std::size_t p = 0; p < Vectors::parts; ++p) {
      relative[p][q] =
          with_other(p, part_of<Part>(motion[i[q]], p), part_of<Part>(motion[j[q]], p));
    }
  }
  const LaneTriple r = transposed(x);
  Vectors vectors;
  vectors.take(relative);
  c.velocity = vectors.centre;
  c.rim_velocity = vectors.rim;
  const Lanes distance = std::experimental::sqrt(dot(r, r));
  c.size = load_lanes(list.contact_size() + k);
  c.effective_mass = load_lanes(list.effective_mass() + k);
  c.overlap = c.size - distance;
  c.normal = (Lanes(1.0) / distance) * r;
}

/// Adds the forces on the vector of pairs that begins at `k`, and their reactions.
template <class Law, class List>
[[gnu::always_inline]] inline void scatter_pairs(PullRow* pull, const List& list, std::size_t k,
                                                 const RowVectors<Law::turns_grains>& on_i) {
  using Vectors = RowVectors<Law::turns_grains>;
  using Part = typename Vectors::Part;
  const std::uint32_t* i = list.i() + k;
  const std::uint32_t* j = list.j() + k;
  typename Vectors::Parts pulls;
  on_i.give(pulls);
  for (std::size_t q = 0; q < lane_count; ++q) {
    for (std::size_t p = 0; p < Vectors::parts; ++p) {
      const Part& one = pulls[p][q];
      set_part<Part>(pull[i[q]], p, part_of<Part>(pull[i[q]], p) + one);
      set_part<Part>(pull[j[q]], p, with_other(p, part_of<Part>(pull[j[q]], p), one));
    }
  }
}

/// Adds the contacts of the pairs in `list` to `pull`; those that have ended go to `ended`, in
/// rising order.
/// Some vectors are gathered, then evaluated, then added: what one vector waits for is hidden
/// behind the others only as far as the processor looks ahead, which is one vector if all is done
/// at once.
template <class LaneMemory, class Law, class List>
PassResult touch_pairs(const Law& law, const RowStore& rows, List& list, PullRow* pull, double dt,
                       std::vector<std::uint32_t>& ended) {
  constexpr std::size_t together = 4;
  PassResult result;
  const std::size_t n = list.size();
  ContactState<Lanes> contacts[together];
  RowVectors<Law::turns_grains> pulls[together];
  for (std::size_t first = 0; first < n; first += together * lane_count) {
    const std::size_t vectors = std::min(together, (n - first + lane_count - 1) / lane_count);
    for (std::size_t b = 0; b < vectors; ++b) {
      gather_pairs<Law>(rows, list, first + b * lane_count, contacts[b]);
    }
    for (std::size_t b = 0; b < vectors; ++b) {
      const std::size_t k = first + b * lane_count;
      const ContactState<Lanes>& c = contacts[b];
      const LaneMask touching = c.overlap > Lanes(0.0);
      auto memory = load_memory<LaneMemory>(list.memory_columns_of(), k);
      const SpringForce<Lanes> f = law(c, memory, dt);
      store_memory(list.memory_columns_of(), k, memory, touching);
      result.count(touching, c.overlap);
      pulls[b].centre = chosen(touching, f.force);
      if constexpr (Law::turns_grains) pulls[b].rim = chosen(touching, f.moment);
      if (touching_count(touching) == lane_count) continue;
      list_set_lanes(!touching, k, n - k, ended);
    }
    for (std::size_t b = 0; b < vectors; ++b) {
      scatter_pairs<Law>(pull, list, first + b * lane_count, pulls[b]);
    }
  }
  return result;
}

/// The pairs of `list` that have come to touch go to `begun`, in rising order.
template <class List>
void find_begun(const RowStore& rows, const List& list, std::vector<std::uint32_t>& begun) {
  const std::size_t n = list.size();
  const Four* place = rows.position.data();
  for (std::size_t k = 0; k < n; k += lane_count) {
    Four x[lane_count];
    for (std::size_t q = 0; q < lane_count; ++q) {
      x[q] = place[list.i()[k + q]] - place[list.j()[k + q]];
    }
    const LaneTriple r = transposed(x);
    const Lanes size = load_lanes(list.contact_size() + k);
    const LaneMask near = dot(r, r) < size * size;
    if (std::experimental::none_of(near)) continue;
    list_set_lanes(near, k, n - k, begun);
  }
}

/// Adds the contacts of rows with one wall to `pull`. `meet` makes normal
/// and overlap of the vector's grains.
template <class LaneMemory, class Law, class List, class Meet>
PassResult touch_wall(const Law& law, const RowStore& rows, List& list, PullRow* pull,
                      double wall_velocity, double dt, Meet meet) {
  using Vectors = RowVectors<Law::turns_grains>;
  using Part = typename Vectors::Part;
  PassResult result;
  for (std::size_t k = 0; k < list.size; k += lane_count) {
    const std::uint32_t* i = list.row.data() + k;
    Four x[lane_count];
    typename Vectors::Parts motion;
    for (std::size_t q = 0; q < lane_count; ++q) {
      x[q] = rows.position[i[q]];
      for (std::size_t p = 0; p < Vectors::parts; ++p) {
        motion[p][q] = part_of<Part>(rows.motion[i[q]], p);
      }
    }
    const LaneTriple r = transposed(x);
    Vectors vectors;
    vectors.take(motion);
    ContactState<Lanes> c;
    c.velocity = vectors.centre;
    c.rim_velocity = vectors.rim;
    c.velocity.z -= Lanes(wall_velocity);
    const Lanes radius = load_lanes(list.radius.data() + k);
    c.size = Lanes(2.0) * radius;
    c.effective_mass = load_lanes(list.mass.data() + k);
    meet(r, radius, c);
    const LaneMask touching = c.overlap > Lanes(0.0) && radius > Lanes(0.0);
    if (std::experimental::none_of(touching)) {
      store_memory(list.memory, k, LaneMemory{}, touching);
      continue;
    }

    auto memory = load_memory<LaneMemory>(list.memory, k);
    const SpringForce<Lanes> f = law(c, memory, dt);
    store_memory(list.memory, k, memory, touching);
    result.count(touching, chosen(touching, c.overlap, Lanes(0.0)));

    vectors.centre = chosen(touching, f.force);
    if constexpr (Law::turns_grains) vectors.rim = chosen(touching, f.moment);
    vectors.give(motion);
    for (std::size_t q = 0; q < lane_count; ++q) {
      for (std::size_t p = 0; p < Vectors::parts; ++p) {
        set_part<Part>(pull[i[q]], p, part_of<Part>(pull[i[q]], p) + motion[p][q]);
      }
    }
  }
  return result;
}

}  // namespace shakebed::simulator
