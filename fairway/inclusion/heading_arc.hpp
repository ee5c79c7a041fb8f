// An arc of headings: from `lo_rad` counter-clockwise over `width_rad`. Angles are not wrapped: an
// arc may be named by any lo, and questions are asked modulo 2 pi.
#pragma once

#include <cmath>

#include "fairway/base/heading.hpp"

namespace fairway {

inline constexpr double whole_turn_rad = 2.0 * pi;

/// In [0, 2 pi]; rounding may give 2 pi itself.
inline double counted_from_zero(double angle_rad) {
  double wrapped =
      angle_rad;  // fmod's own result, bit by bit: differences of such numbers are exact
  if (!(std::abs(angle_rad) < whole_turn_rad)) {
    wrapped = std::abs(angle_rad) < 2.0 * whole_turn_rad
                  ? angle_rad - std::copysign(whole_turn_rad, angle_rad)
                  : std::fmod(angle_rad, whole_turn_rad);
  }
  return wrapped < 0.0 ? wrapped + whole_turn_rad : wrapped;
}

struct HeadingArc {
  double lo_rad = 0.0;
  double width_rad = 0.0;

  double hi_rad() const { return lo_rad + width_rad; }
  HeadingArc widened(double by_rad) const { return {lo_rad - by_rad, width_rad + 2.0 * by_rad}; }
  /// Whether some heading of `other` (both ends included) is one of this arc.
  bool meets(HeadingArc other) const {
    const double behind = counted_from_zero(lo_rad - other.lo_rad);
    return behind <= other.width_rad || behind + width_rad >= whole_turn_rad;
  }
  /// The arc over both, for arcs less than pi apart: this one, and `other` where it lies nearest.
  HeadingArc with(HeadingArc other) const {
    const double middle = lo_rad + 0.5 * width_rad;
    const double at =
        middle + std::remainder(other.lo_rad + 0.5 * other.width_rad - middle, whole_turn_rad);
    const double lo = std::fmin(lo_rad, at - 0.5 * other.width_rad);
    const double hi = std::fmax(hi_rad(), at + 0.5 * other.width_rad);
    return {lo, hi - lo};
  }
};

}  // namespace fairway
