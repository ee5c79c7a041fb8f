// The raw field (paper 1, section IV): gradient descent on the cost in safe start, towards the
// buffer's outer border elsewhere, along the path on a path.
#pragma once

#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/field/buffer_border.hpp"
#include "fairway/field/complete_map.hpp"
#include "fairway/field/field.hpp"
#include "fairway/field/vector_field.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway {

/// Reads the safe-start cost and adds to it the cost of buffer cells (way to the border, and the
/// border's cost). Where the straight line from a buffer cell to the nearest border cell is barred
/// by an obstacle, the shortest way round through the buffer is taken instead, and `border` is
/// set to that way's border cell; buffer cells with no way out keep +inf and get no direction.
/// With Metric::paper everything is straight, and obstacle cells are given directions too, as
/// printed. Metric::euclidean follows the eikonal's triangles, the others the steepest of the
/// eight neighbours.
[[nodiscard]] VectorField raw_field(const Grid& grid, const CompleteMap& complete,
                                    const Mission& mission, Metric metric,
                                    std::vector<float>& cost_cells, BufferBorder& border);

}  // namespace fairway
