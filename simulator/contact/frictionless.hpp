#pragma once

#include "simulator/contact/contact_kind.hpp"

namespace shakebed::simulator {

/// No tangential force: grains carry no spin, contacts no memory.
struct Frictionless {
  static constexpr bool turns_grains = false;

  template <class Real>
  struct Memory {};

  template <class Kind>
  explicit Frictionless(const Kind&) {}
};

}  // namespace shakebed::simulator
