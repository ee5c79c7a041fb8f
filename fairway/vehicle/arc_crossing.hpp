// Where the arcs of a set of states cross the sides of a cell (cell_enclosure.hpp, (a) to (c)).
#pragma once

#include <cmath>

#include "fairway/base/interval.hpp"
#include "fairway/vehicle/cell_sets.hpp"
#include "fairway/vehicle/cell_shape.hpp"
#include "fairway/vehicle/side.hpp"

namespace fairway::cell_enclosure {

/// An event on an arc: its heading there gives the order of events. For a `possible` one, also
/// where the side is left.
struct ArcEvent {
  IntervalVec2 heading;
  bool possible = false;  ///< it may be the first for some state
  bool certain = false;   ///< every state meets it or another before turning 90 degrees
  Side side = Side::right;
  bool low_corner = false;
  bool high_corner = false;
  Interval along_m;
  IntervalVec2 centre_m;
};

struct Turn {
  const CellEntry& entry;
  const CellOrder& order;
  const CellShape& shape;
  int sign;
  bool may_align;   ///< some state may reach the command within 90 degrees
  bool must_align;  ///< every state would
  IntervalVec2 centre_m;
};

/// Outward and tangential parts of the headings with which a side is crossed.
struct ExitHeading {
  Interval across;
  Interval along;

  bool empty() const { return across.empty() || along.empty(); }
  IntervalVec2 of(Side side) const {
    return from_parts(is_far(side) ? across : -across, along, side);
  }
  /// Keeps what lies on the unit circle: each part limits the other.
  void to_circle() {
    if (empty()) return;
    across = intersection(across, sqrt(Interval(1.0) - square(along)));
    if (across.empty()) return;
    const Interval size = sqrt(Interval(1.0) - square(across));
    if (along.positive()) along = intersection(along, size);
    if (along.negative()) along = intersection(along, -size);
  }
};

/// Keeps the headings from the entry's to the command's. Along an arc of less than 90 degrees a
/// component goes from its value at one end to that at the other, unless the arc passes that axis,
/// which it does not when the other component has the same sign at both ends.
inline void cut_at_command(const Turn& turn, Side side, ExitHeading& exit) {
  const IntervalVec2& u = turn.entry.heading;
  const IntervalVec2& c = turn.order.heading;
  const Interval u_across = outward_part(u, side);
  const Interval c_across = outward_part(c, side);
  const Interval& u_along = along(u, side);
  const Interval& c_along = along(c, side);
  if ((u_along.positive() && c_along.positive()) || (u_along.negative() && c_along.negative())) {
    exit.across = intersection(exit.across, hull(u_across, c_across));
  }
  if (u_across.positive() && c_across.positive()) {
    exit.along = intersection(exit.along, hull(u_along, c_along));
  }
  exit.to_circle();
}

/// Where the arc crosses the line of `side` outwards: (b) and (c).
inline void crossing(const Turn& turn, Side side, ArcEvent& event) {
  const double d = turn.shape.cell_m;
  const double r = turn.shape.turn_radius_m;
  const double k = is_vertical(side) ? turn.sign : -turn.sign;
  const double outwards = is_far(side) ? 1.0 : -1.0;
  const Interval line = line_of(side, d);
  const Interval tangent = with_sign(k, line - across(turn.centre_m, side)) / r;
  if (tangent.lo > 1.0 || tangent.hi < -1.0) return;
  ExitHeading exit;
  exit.along = intersection(tangent, {-1.0, 1.0});
  exit.across = sqrt(Interval(1.0) - square(exit.along));
  Interval offset = (-k * r * outwards) * exit.across;
  Interval place = along(turn.centre_m, side) + offset;
  // Off the side: a state that gets there has already left through another side.
  if (place.hi < 0.0 || place.lo > d) return;
  event.heading = exit.of(side);
  const Interval turned = with_sign(turn.sign, cross(turn.entry.heading, event.heading));
  const Interval ahead = dot(turn.entry.heading, event.heading);
  if (turned.hi < 0.0 || ahead.hi < 0.0) return;
  event.certain = tangent.lo > -1.0 && tangent.hi < 1.0 && turned.lo >= 0.0 && ahead.lo > 0.0;
  if (turn.must_align) {
    cut_at_command(turn, side, exit);
    if (exit.empty()) return;
    offset = (-k * r * outwards) * exit.across;
    place = along(turn.centre_m, side) + offset;
  }
  event.along_m = intersection(place, {0.0, d});
  if (event.along_m.empty()) return;
  event.side = side;
  event.low_corner = place.lo <= corner_reach_m(d);
  event.high_corner = place.hi >= d - corner_reach_m(d);
  if (event.low_corner || event.high_corner) {
    // What passes between the corners determines the headings that do ...
    exit.across = intersection(
        exit.across, (event.along_m - along(turn.centre_m, side)) / Interval(-k * r * outwards));
    exit.to_circle();
    if (exit.empty()) return;
    offset = (-k * r * outwards) * exit.across;
  }
  // ... and the centres: along the side directly, across it through the heading.
  const Interval centre_along = intersection(along(turn.centre_m, side), event.along_m - offset);
  const Interval centre_across =
      intersection(across(turn.centre_m, side), line - (k * r) * exit.along);
  if (centre_along.empty() || centre_across.empty()) return;
  event.possible = true;
  event.heading = exit.of(side);
  event.centre_m = from_parts(centre_across, centre_along, side);
}

}  // namespace fairway::cell_enclosure
