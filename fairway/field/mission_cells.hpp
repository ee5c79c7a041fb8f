// The cells of a mission: the goal disc (paper 1, Eq. 4) and the cells a path crosses (Eq. 5).
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway {

/// Flat indices of the cells that lie wholly inside the closed disc, ascending. `center_m` finite.
[[nodiscard]] std::vector<std::uint32_t> cells_inside_disc(const Grid& grid, Vec2 center_m,
                                                           double radius_m);

/// One cell that a path crosses, and the piece, of those crossing it, nearest to its centre.
struct PathCell {
  std::uint32_t index = 0;
  Vec2 tangent;             ///< unit vector along that piece
  double distance_m = 0.0;  ///< from the cell's centre to that piece
  double to_end_m = std::numeric_limits<double>::infinity();  ///< from the piece's point nearest
                                                              ///< to the centre, along the path to
                                                              ///< its open end; closed: none
};

/// All cells of the grid that the polyline touches, ascending by index, each once. Cells met only
/// at a corner or along a side count: the set is connected by sides and corners.
[[nodiscard]] std::vector<PathCell> cells_on_path(const Grid& grid, const PathMission& path);

/// The same with all their neighbours, each with the nearest of the pieces that cross the cell or a
/// neighbour: distances to the path on both of its sides.
[[nodiscard]] std::vector<PathCell> cells_near_path(const Grid& grid, const PathMission& path);

}  // namespace fairway
