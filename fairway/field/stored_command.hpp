// From a direction to the command that a plan stores.
#pragma once

#include <cmath>

#include "fairway/base/heading.hpp"
#include "fairway/base/vec2.hpp"

namespace fairway {

inline double captured_by_axis(double angle_rad, double capture_rad) {
  const double axis_rad = std::round(angle_rad / (pi / 2)) * (pi / 2);
  return std::fabs(angle_rad - axis_rad) <= capture_rad ? axis_rad : angle_rad;
}

/// Whether a filtered vector is too short to have a direction.
inline bool has_vanished(float x, float y) {
  constexpr float vanishing = 1e-4F;
  return x * x + y * y < vanishing * vanishing;
}

/// The heading of (x, y), on an axis if it is that close to one.
inline float stored_command(float x, float y, double capture_rad) {
  return Heading::stored(captured_by_axis(std::atan2(y, x), capture_rad));
}

}  // namespace fairway
