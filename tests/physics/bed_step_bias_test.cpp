// A bed stepped coarsely is a bed of grains that lose more: as much as one of grains whose e'^2 is
// the mean of e^2 over where in a step a collision begins.
#include <catch2/catch.hpp>
#include <cmath>

#include "simulator/scene/read_scene.hpp"
#include "simulator/simulate.hpp"
#include "tests/physics/impact.hpp"

namespace shakebed::tests {
namespace {

constexpr double e = 0.9;

simulator::Estimate T_z_of_bed(double restitution, double steps_in_contact, bool closed) {
  const auto scene = simulator::read_scene(
      files::YamlNode::load_text("scene: 1\n"
                                 "dimension: 2\n"
                                 "grains: {layers: 4, restitution: 0.9}\n"
                                 "cell: [5]\n"
                                 "base: {drive: {W: 5.6, amplitude: 1}}\n"
                                 "protocol: {measure: {until: {T_z: 0.35 %}, at_most: 200000}}\n",
                                 "bed"),
      {{"grains.restitution", std::to_string(restitution)},
       {"base.restitution", std::to_string(restitution)},
       {"protocol.time_step.fraction_of_contact_duration", std::to_string(1 / steps_in_contact)},
       {"protocol.contacts", closed ? "closed" : "fine"}});
  const auto record = simulator::simulate(scene);
  for (const auto& quantity : record.quantities) {
    if (quantity.name == "T_z") return quantity.estimate;
  }
  return {};
}

}  // namespace

// Seeds are fixed; with other seeds the margins alarm at 4 sigma, 6e-5 each.
TEST_CASE("bed: stepping coarsely is a lower restitution, and of second order with it") {
  const auto exact = T_z_of_bed(e, 50, true);
  const auto fall_to = [&](const simulator::Estimate& T_z) {
    return simulator::Estimate{std::log(exact.mean / T_z.mean), T_z.standard_error / T_z.mean};
  };
  const double steps[2] = {5, 10};
  simulator::Estimate stepped[2];
  for (int k = 0; k < 2; ++k) {
    const double lost = (1 - e * e) * loss_ratio(e, steps[k]);
    stepped[k] = fall_to(T_z_of_bed(e, steps[k], false));
    const auto lossy = fall_to(T_z_of_bed(std::sqrt(1 - lost), 50, true));
    INFO("t_c/dt = " << steps[k] << ": ln(T_0/T) = " << stepped[k].mean << ", with e' "
                     << lossy.mean << " +- " << lossy.standard_error);
    CHECK(std::abs(stepped[k].mean - lossy.mean) <
          4 * std::hypot(stepped[k].standard_error, lossy.standard_error));
  }
  const double exact_error = exact.standard_error / exact.mean;
  double square = 0;
  for (const auto& one : stepped) {
    square += std::pow(std::hypot(one.standard_error, exact_error) / one.mean, 2);
  }
  const double order = std::log2(stepped[0].mean / stepped[1].mean);
  const double order_error = std::sqrt(square) / std::log(2.0);
  const double expected = std::log2(std::log(loss_ratio(e, 5)) / std::log(loss_ratio(e, 10)));
  INFO("order " << order << " +- " << order_error << ", one collision: " << expected);
  CHECK(std::abs(order - expected) < 4 * order_error);
  CHECK(order > 1 + 2 * order_error);
}

}  // namespace shakebed::tests
