// Lines of equal value over a lattice of samples, by marching squares.
//
// Properties that always hold:
//   1. every vertex lies on a lattice edge whose ends are finite and on both sides of the level
//      (an end that equals the level counts as above), placed by linear interpolation;
//   2. lines do not cross, and end only at the rim of the finite samples; a line that closes
//      repeats its first vertex at the end.
// Error: of second order in the lattice step for a smooth value. Cost: linear in the samples.
#pragma once

#include <span>
#include <vector>

#include "fairway/base/vec2.hpp"

namespace fairway {

/// `value` is [iy][ix], nx by ny; a sample that is not finite cuts the four squares around it out.
/// Vertices are in lattice steps: sample (ix, iy) is at (ix, iy).
[[nodiscard]] std::vector<std::vector<Vec2>> contour_lines(int nx, int ny,
                                                           std::span<const float> value,
                                                           double level);

}  // namespace fairway
