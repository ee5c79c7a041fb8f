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

/// How a line is approached, metres.
struct Approach {
  double circle_m = 0.0;  ///< R, radius of the circles
  double flat_m = 0.0;    ///< nearer than this the command runs along the line
  double band_m = 0.0;    ///< farther than this there is a wall close by; +inf: none
  double turn_radius_m = 0.0;
  double overshoot_m = 0.0;  ///< beyond the band: how far the line may be overshot
};

/// A(distance), 0 to pi / 2, for distance_m >= 0:
///   acos(1 - (distance - flat) / R), 0 within flat, pi / 2 from flat + R on;
///   beyond the band at least acos(1 - (distance + overshoot) / r), 88 degrees at most.
/// With R >= r, and flat at least half a cell's extent across the line, a vehicle that flies
/// backwards along a straight line turns away from it: it does not weave along it for ever. The
/// second term turns vehicles away from a wall early and lets those that face backwards come round
/// in a corridor narrower than two turns; whoever obeys it is parallel to the line again before it
/// is the overshoot beyond it.
[[nodiscard]] double approach_angle_rad(double distance_m, const Approach& approach);

/// Sets the commands of cells within R = 3 r of the line; beyond the ends of an open path they
/// point back at the end. `field`, the paper's smoothed field, stays where an obstacle lies between
/// a cell and the line (the way through free cells, `cost_cells`, is longer than straight to the
/// line; faded over r), and takes over as far as needed where the new command would meet an
/// obstacle within r that the old one does not meet. Cells without a direction, and obstacles, are
/// unchanged.
void follow_field(const Grid& grid, const CompleteMap& complete, const PathMission& path,
                  const std::vector<float>& cost_cells, const Vehicle& vehicle, VectorField& field);

}  // namespace fairway
