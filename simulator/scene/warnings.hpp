#pragma once

#include <string>
#include <vector>

#include "simulator/contact/column_parameters.hpp"
#include "simulator/contact/parameters.hpp"
#include "simulator/scene/scene.hpp"

namespace shakebed::simulator {

/// Largest overlap to expect [d], to size k_n by: grains that meet the base at twice V_p, and the
/// column of N grains at rest, each alone on a linear spring (m_eff = m at the base):
///   delta = 2 V_p sqrt(m/k_n) + N m g/k_n.
/// An estimate: in a deep bed the impact of the whole column reaches further.
double expected_largest_overlap(const Scene& scene, const Parameters& parameters);

/// Above this [d] a scene is refused unless it says allow_soft.
inline constexpr double meaningless_overlap = 0.5;

/// Deeper beds than this [layers] are refused, unless they say allow_soft, when k_n is less than
/// 1/most_softness of what `auto` takes: twenty layers on the k_n of four, for instance.
inline constexpr double usual_layers = 4;
inline constexpr double most_softness = 4;

/// omega t_c [rad], t_c the longer of the contact durations: the share of the drive's cycle that
/// one contact takes. Above about 0.1 the bed feels the softness of its contacts.
double drive_angle_in_contact(const Scene& scene, const Parameters& parameters);

/// What a user should know before trusting this bed, though it can be simulated.
std::vector<std::string> scene_warnings(const Scene& scene, const Parameters& parameters);

/// The same of a bed in a container: kinds of contact that are over-damped, or nearly.
std::vector<std::string> column_warnings(const ColumnParameters& parameters);

}  // namespace shakebed::simulator
