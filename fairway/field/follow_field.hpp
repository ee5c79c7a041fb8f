// The field of a path mission that is followed: commands approach the line on circles and run
// along it (docs/following.md).
//
// At signed distance e from the line the command is the line's direction there turned towards the
// line by A(|e|), `approach_angle_rad`. The line is the path with its corners cut to arcs that the
// vehicle can fly (flyable_path.hpp), and its direction is looked up half a cell ahead: within a
// cell the command does not turn, so that it would lag by that much.
#pragma once

#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/field/complete_map.hpp"
#include "fairway/field/vector_field.hpp"
#include "fairway/vehicle/mission.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// A(distance), 0 to pi / 2, for distance_m >= 0: the smaller of acos(1 - distance / circle_m), the
/// angle of a circle that touches the line (pi / 2 from circle_m on), and distance / radian_m.
///
/// Whoever flies as it says turns with a radius of at least circle_m / 2. With circle_m > r one
/// that flies backwards along a straight line turns away from it: it does not weave along it for
/// ever. The circle's angle rises at once, like a root: the second one bounds how much the commands
/// of neighbouring cells differ at the line, which is where those that follow are.
[[nodiscard]] double approach_angle_rad(double distance_m, double circle_m, double radian_m);

/// Sets the commands of cells within R = 2.5 r of the line; beyond the ends of an open path they
/// point back at the end. `field`, the paper's smoothed field, stays where an obstacle lies between
/// a cell and the line (the way through free cells, `cost_cells`, is longer than straight to the
/// line; faded over r), and takes over as far as needed where the new command would meet an
/// obstacle within r that the old one does not meet. Cells without a direction, and obstacles, are
/// unchanged.
void follow_field(const Grid& grid, const CompleteMap& complete, const PathMission& path,
                  const std::vector<float>& cost_cells, const Vehicle& vehicle, VectorField& field);

}  // namespace fairway
