#pragma once

#include "simulator/contact/contact_kind.hpp"

namespace shakebed::simulator {

/// No tangential force: grains carry no spin.
struct Frictionless {
  static constexpr bool turns_grains = false;

  explicit Frictionless(const ContactKind&) {}
};

}  // namespace shakebed::simulator
