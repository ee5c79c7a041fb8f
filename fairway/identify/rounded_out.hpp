// Numbers of a contract in three digits, rounded to the side that widens it.
#pragma once

#include <cmath>

namespace fairway {

/// The decimal of three significant digits at or beyond `value` >= 0. Written with {:.3g}.
[[nodiscard]] inline double rounded_out(double value, bool up) {
  if (!(value > 0.0)) return 0.0;
  const int exponent = 2 - static_cast<int>(std::floor(std::log10(value)));
  const double unit = std::pow(10.0, std::abs(exponent));
  const double scaled = exponent >= 0 ? value * unit : value / unit;
  constexpr double as_good_as_whole = 1e-9;
  const double whole = up ? std::ceil(scaled - as_good_as_whole * scaled)
                          : std::floor(scaled + as_good_as_whole * scaled);
  return exponent >= 0 ? whole / unit : whole * unit;
}

}  // namespace fairway
