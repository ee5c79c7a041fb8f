// Border-to-border forward reachability (paper 2, section IV, Eqs. 12 to 16): the headings Phi with
// which a vehicle can leave a cell at a point of one border when it came in by another.
//
// Seen from the border of entry as the bottom, a left arc that leaves at height y with heading w
// began with heading t, cos t = cos w + y / r. It is flown if the command lies beyond w and less
// than half a turn from t, so its exit headings are one range: from the arc that begins at the near
// corner to that which begins at the far one (or touches a side), cut off at the command, and at
// the heading whose arc begins opposite to the command (Eqs. 12, 15). Right arcs are their mirror
// image (Eqs. 13, 14). A vehicle that has aligned leaves with the command itself: possible when the
// command lies between the first right arc and the last left one. Together up to three pieces: two
// disjoint ranges for backward commands (Figs. 12c, 18c, 20), and the command alone where no arc
// ends with it (Figs. 10c, 16b).
// Angles are taken from chords and tangents; the paper's comparisons of angles are made on the
// circle. All pairs of borders, the border of entry itself included.
// Properties that always hold, for points that are not corners:
//   1. The ends belong to the set, though the path that leads to one may only touch a corner.
// Error (observed against cross_cell over random draws, see the test): no exit lies more than 1e-7
// rad outside, and every heading farther than that inside is flown.
#pragma once

#include "fairway/cellular/border_heading_set.hpp"
#include "fairway/vehicle/cell_motion.hpp"
#include "fairway/vehicle/side.hpp"

namespace fairway {

/// Phi at the point `along_m` along `exit`, in the direction of +x or +y, for entries anywhere on
/// `entry`. Throws PreconditionViolation when the point is not on the border or the cell is not
/// smaller than the turning radius.
[[nodiscard]] HeadingSet forward_headings(Side entry, Side exit, double along_m,
                                          const Direction& command, const CellShape& shape);

}  // namespace fairway
