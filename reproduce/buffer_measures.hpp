// The distance that a plan's buffer keeps. Eq. 3 of paper 1 measures from points of obstacles to
// points; the program from cell to cell.
#pragma once

#include "fairway/field/field.hpp"

namespace fairway::reproduce {

struct BufferMeasures {
  double least_m = 0.0;  ///< from a point of a free or goal cell to a point of an obstacle cell
  double share = 0.0;    ///< of those cells with a point in the buffer of Eq. 3
};

/// `width_m`: alpha r.
[[nodiscard]] BufferMeasures buffer_measures(const Grid& grid, const std::vector<Region>& region,
                                             double width_m);

}  // namespace fairway::reproduce
