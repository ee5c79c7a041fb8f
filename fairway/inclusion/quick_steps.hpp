// Where the steps of a QuickFlight end, and which parts its sets lie over.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "fairway/base/vec2.hpp"
#include "fairway/inclusion/heading_arc.hpp"

namespace fairway {

// Steps end at multiples of an eighth of a turn, at least, so that within one no direction of the
// octagon changes its sign.
inline constexpr unsigned finest_bits = 24;
inline constexpr std::size_t finest_steps = 256;

inline const std::array<Vec2, finest_steps>& step_ends() {
  static const std::array<Vec2, finest_steps> made = [] {
    std::array<Vec2, finest_steps> all;
    for (std::size_t k = 0; k < finest_steps; ++k) {
      const double angle = whole_turn_rad / finest_steps * static_cast<double>(k);
      all[k] = {std::cos(angle), std::sin(angle)};
    }
    return all;
  }();
  return made;
}

// Of coordinates, which are far above -2^12: a truncation of what is positive. It is off by less
// than 2^-40, and sets are larger than what they hold by far more.
inline constexpr double far_below = 0x1p12;
inline int floor_of(double v) {
  return static_cast<int>(v + far_below) - static_cast<int>(far_below);
}
inline int ceiling_of(double v) {
  return static_cast<int>(far_below) - static_cast<int>(far_below - v);
}

}  // namespace fairway
