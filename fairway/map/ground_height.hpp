// Plausible heights, and the values that programs write for unknown ones.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace fairway {

/// True when ground, or what stands on it, can have this height: from below the deepest sea to
/// above the highest mountain.
inline bool can_be_ground(double height_m) { return height_m >= -12'000.0 && height_m <= 9'000.0; }

/// True for the usual values for "none", as stored in the file (before scale and offset).
inline bool stands_for_none(double sample) {
  constexpr std::array<double, 7> none{-999.0,    -9'999.0, -10'000.0, -32'767.0,
                                       -32'768.0, 32'767.0, 65'535.0};
  return !(std::abs(sample) < 1e30) || std::find(none.begin(), none.end(), sample) != none.end();
}

}  // namespace fairway
