// Evenly spaced lines along a plan's field (B. Jobard and W. Lefer, Creating evenly-spaced
// streamlines of arbitrary density, 1997).
//
// Between cell centres the direction is the bilinear mean of the commanded unit vectors of the
// cells that have one and are not obstacles; where they cancel to less than `least_agreement` of
// their length, there is no direction and a line ends.
//
// Properties that always hold:
//   1. points of different lines are at least 0.5 * separation_m apart;
//   2. consecutive points are one step apart, along the interpolated direction (midpoint rule, so
//      the error is of second order in the step): half a cell, but at least 0.02 and at most 0.2
//      of separation_m, so that big plans cost no more than they can show;
//   3. no point lies in an obstacle, in a cell without a command, or outside the grid;
//   4. no line is shorter than separation_m.
// Cost: the field's area / (separation_m * step), whatever the number of cells.
#pragma once

#include <optional>
#include <vector>

#include "fairway/base/vec2.hpp"
#include "fairway/plan/plan.hpp"

namespace fairway {

/// The interpolated direction, a unit vector, or nothing (see above).
[[nodiscard]] std::optional<Vec2> field_direction(const Plan& plan, Vec2 point_m);

/// Lines run with the field, from start to end. separation_m > 0.
[[nodiscard]] std::vector<std::vector<Vec2>> evenly_spaced_streamlines(const Plan& plan,
                                                                       double separation_m);

}  // namespace fairway
