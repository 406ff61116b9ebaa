// A bed stepped coarsely is a bed of grains that lose more: T_z goes as the inverse of the energy
// lost in a collision, as both the base's power and the temperature are set by 1 - e^2 (kinetic
// theory of a vibrated bed: Kumaran, Phys. Rev. E 57, 5660 (1998), T ~ V_p^2/(1 - e^2) per layer).
#include <catch2/catch.hpp>
#include <cmath>

#include "simulator/scene/read_scene.hpp"
#include "simulator/simulate.hpp"
#include "tests/physics/impact.hpp"

namespace shakebed::tests {
namespace {

constexpr double e = 0.9;

simulator::Estimate T_z_of_stepped_bed(double steps_in_contact, bool closed) {
  const auto scene = simulator::read_scene(
      files::YamlNode::load_text("scene: 1\n"
                                 "dimension: 2\n"
                                 "grains: {layers: 4, restitution: 0.9}\n"
                                 "cell: [5]\n"
                                 "base: {drive: {W: 5.6, amplitude: 1}}\n"
                                 "protocol: {measure: {until: {T_z: 0.35 %}, at_most: 200000}}\n",
                                 "bed"),
      {{"protocol.time_step.fraction_of_contact_duration", std::to_string(1 / steps_in_contact)},
       {"protocol.contacts", closed ? "closed" : "fine"}});
  const auto record = simulator::simulate(scene);
  for (const auto& quantity : record.quantities) {
    if (quantity.name == "T_z") return quantity.estimate;
  }
  return {};
}

}  // namespace

// Seeds are fixed; with other seeds the margins alarm at 4 sigma, 6e-5 each.
TEST_CASE("bed: bias by stepping is that of a single collision, and of second order with it") {
  const auto exact = T_z_of_stepped_bed(50, true);
  double fall[2];
  double error[2];
  const double steps[2] = {5, 10};
  for (int k = 0; k < 2; ++k) {
    const auto T_z = T_z_of_stepped_bed(steps[k], false);
    fall[k] = std::log(exact.mean / T_z.mean);
    error[k] = std::hypot(T_z.standard_error / T_z.mean, exact.standard_error / exact.mean);
    INFO("t_c/dt = " << steps[k] << ": ln(T_0/T) = " << fall[k] << " +- " << error[k]
                     << ", one collision: " << std::log(loss_ratio(e, steps[k])));
    CHECK(std::abs(fall[k] - std::log(loss_ratio(e, steps[k]))) < 4 * error[k]);
  }
  const double order = std::log2(fall[0] / fall[1]);
  const double order_error = std::hypot(error[0] / fall[0], error[1] / fall[1]) / std::log(2.0);
  const double expected = std::log2(std::log(loss_ratio(e, 5)) / std::log(loss_ratio(e, 10)));
  INFO("order " << order << " +- " << order_error << ", one collision: " << expected);
  CHECK(std::abs(order - expected) < 4 * order_error);
  CHECK(order > 1 + 2 * order_error);
}

}  // namespace shakebed::tests
