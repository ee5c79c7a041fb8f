// Cellular backward reachability (paper 2, section III, Eqs. 4 to 11): the headings Theta from
// which a vehicle at a point of a cell leaves it by a given border under the bang-bang law.
//
// Two arcs of one radius from one point do not meet again within a cell, and straight ends of one
// direction never do. So, as the starting heading turns counter-clockwise once round, starting
// opposite to the command, the exit moves counter-clockwise along the cell's border. The headings
// for one border therefore are one range, whose ends are the headings that lead past the border's
// two corners; or nothing, when both corners lie in the gap that no path reaches (behind the
// vehicle's turning circles, Eq. 11). Which path leads past a corner depends on the command (Eqs. 4
// to 10): a left arc, a right arc, an arc and then the straight line through the corner; arcs that
// would bulge out of the cell before the corner are replaced by the arc that touches the side.
// Angles are taken from chords and tangents, never from slopes, so that vertical and horizontal
// commands are not special cases. Properties that always hold, for points that are not corners:
//   1. On the cell's border, headings out of the cell count as leaving at once.
//   2. The ends of ranges belong to both borders that meet there.
// Error (observed against cross_cell over random draws, see the test): no heading farther than 1e-7
// rad from an end gets the wrong border. (Where an arc touches a side, an ulp of position is the
// square root of an ulp in heading.)
#pragma once

#include "fairway/cellular/border_heading_set.hpp"
#include "fairway/vehicle/cell_motion.hpp"
#include "fairway/vehicle/side.hpp"

namespace fairway {

/// Theta of `exit` at a point in [0, cell_m]^2, all headings: nothing or one range. Throws
/// PreconditionViolation when the point is outside or the cell is not smaller than the turning
/// radius.
[[nodiscard]] HeadingSet backward_headings(Vec2 point_m, const Direction& command,
                                           const CellShape& shape, Side exit);

/// The paper's border-to-border Theta (section III.C): only headings that enter the cell. Nothing,
/// one range, or two: shallow arcs lead back to the border of entry from both ends of the half
/// circle.
[[nodiscard]] HeadingSet backward_headings_on_border(Side entry, double along_m,
                                                     const Direction& command,
                                                     const CellShape& shape, Side exit);

}  // namespace fairway
