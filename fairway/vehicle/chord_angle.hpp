// The angle of an arc from its chord: calling asin would cost a third of a cell crossing.
#pragma once

#include <algorithm>
#include <cmath>

#include "fairway/base/vec2.hpp"

namespace fairway {

/// Angle in [0, pi] of an arc with this chord on a circle of diameter 1 / per_diameter: 2 asin s
/// with s = chord / diameter. Up to s = 1/2 a polynomial in s^2, asin s = s + s^3 p(s^2), p of
/// degree 11 through the Chebyshev nodes of [0, 1/4]; its relative error is 6e-17 before rounding.
inline double chord_angle(Vec2 chord, double per_diameter) {
  const double z = norm2(chord) * (per_diameter * per_diameter);
  const double s = std::sqrt(z);
  if (z > 0.25) [[unlikely]]
    return 2.0 * std::asin(std::min(1.0, s));
  // In pairs, then pairs of pairs: evaluating twelve terms in sequence would have a long latency.
  const double z2 = z * z;
  const double z4 = z2 * z2;
  const double p0 = (0.1666666666666665 + 0.07500000000020764 * z) +
                    (0.044642857103423646 + 0.03038194736709848 * z) * z2;
  const double p4 = (0.02237204763174451 + 0.017355259955786323 * z) +
                    (0.013929652902326633 + 0.011875494382636924 * z) * z2;
  const double p8 = (0.007802949477353317 + 0.016035514349148825 * z) +
                    (-0.010749050339697811 + 0.028169218060881417 * z) * z2;
  return 2.0 * (s + s * z * (p0 + z4 * (p4 + z4 * p8)));
}

}  // namespace fairway
