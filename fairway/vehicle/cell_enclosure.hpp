// Where a set of states can leave a cell, and how: an enclosure of the exact motion (docs/model.md)
// in intervals. In the code behind the proof, only this file knows how the vehicle moves inside a
// cell (ARCHITECTURE.md, "What knows the motion"); what builds on it knows only "these states
// enter, these may leave".
//
// The motion is one arc, then a straight line. On an arc of centre C and sign k (+1 left, -1 right)
//     p = C + k r (u_y, -u_x),                                                              (a)
// so a set of states on an arc is kept as a set of centres: it does not grow while the turn lasts,
// over any number of cells. For each side of a cell there is exactly one point of the circle where
// the motion crosses the side's line outwards, and there, by (a),
//     right, left:  u_y =  k (line - C_x) / r,  u_x = +-sqrt(1 - u_y^2),  y = C_y - k r u_x, (b)
//     top, bottom:  u_x = -k (line - C_y) / r,  u_y = +-sqrt(1 - u_x^2),  x = C_x + k r u_y. (c)
// A state inside a convex cell leaves it by the first of these four, unless it aligns first; and
// in one cell it turns by less than 90 degrees (its chord is at most sqrt(2) cell_m < sqrt(2) r),
// so the order of two events is the sign of the cross product of their headings.
//
// Properties that always hold, when cell_m < turn_radius_m and not `too_wide`:
//   1. Every state of the entry leaves as one of the departures says, or never leaves; it always
//      leaves when there is a command or a heading to go straight on.
//   2. At the exactly opposite heading both turns are followed; a touch of a side is a departure;
//      a set that straddles a corner departs through both sides, each part cut at the corner.
//   3. length_m bounds the distance that any state flies inside the cell.
// Includes only standard headers and the project's own toolboxes; no heap, no exceptions. Lemmas 2
// and 3 of docs/trust.md are about this file and the two it builds on, cell_sets.hpp and
// arc_crossing.hpp.
#pragma once

#include <cmath>

#include "fairway/base/interval.hpp"
#include "fairway/base/short_list.hpp"
#include "fairway/vehicle/arc_crossing.hpp"
#include "fairway/vehicle/cell_sets.hpp"
#include "fairway/vehicle/cell_shape.hpp"
#include "fairway/vehicle/side.hpp"

namespace fairway {

namespace cell_enclosure {

/// Straight on from `from` (a part of the closed cell) along `model.heading` to every side that may
/// be met first; each departure is `model` except for where it leaves.
inline void leave_straight(const IntervalVec2& from, const CellDeparture& model,
                           const CellShape& shape, CellDepartures& departures) {
  const double d = shape.cell_m;
  for (const Side side : {Side::right, Side::top, Side::left, Side::bottom}) {
    const Interval speed = outward_part(model.heading, side);
    if (speed.hi < 0.0) continue;
    const Interval pace = along(model.heading, side);
    const Interval start = along(from, side);
    const Interval gap = intersection(
        is_far(side) ? Interval(d) - across(from, side) : across(from, side), {0.0, above(d)});
    CellDeparture leave = model;
    leave.side = side;
    Interval place;
    if (speed.positive()) {
      place = start + gap * (pace / speed);
      leave.length_m = above(std::min((gap / speed).hi, 1.5 * d));
    } else {  // possibly along the side: far along it, unless already on it
      leave.grazes = true;
      if (speed.hi == 0.0 && gap.lo > 0.0) continue;
      const double least = gap.lo <= 0.0 ? 0.0 : gap.lo / speed.hi * 0.5;  // |pace| > 1 / 2
      if (pace.lo > 0.5) {
        place = {below(start.lo + least), d};
        leave.length_m = std::min(1.5 * d, above(above(d - start.lo) / pace.lo));
      } else if (pace.hi < -0.5) {
        place = {0.0, above(start.hi - least)};
        leave.length_m = std::min(1.5 * d, above(start.hi / -pace.hi));
      } else {
        departures.too_wide = true;
        return;
      }
    }
    leave.along_m = intersection(place, {0.0, d});
    if (leave.along_m.empty()) continue;
    // A state running along the side, on it, ends at the corner, where the side ahead is left, too.
    const bool on_side = speed.lo == 0.0 && speed.hi == 0.0;
    leave.low_corner = !on_side && place.lo <= corner_reach_m(d);
    leave.high_corner = !on_side && place.hi >= d - corner_reach_m(d);
    leave.length_m = above(leave.length_m + model.length_m);
    departures.add(leave);
  }
}

/// Whether all headings between two sets less than 90 degrees apart lie in one closed quadrant.
inline bool keeps_quadrant(const IntervalVec2& u, const IntervalVec2& c) {
  const auto one_sign = [](const Interval& a, const Interval& b) {
    return (a.lo >= 0.0 && b.lo >= 0.0) || (a.hi <= 0.0 && b.hi <= 0.0);
  };
  return one_sign(u.x, c.x) && one_sign(u.y, c.y);
}

/// Where the turn that reaches the command ends: (a).
inline IntervalVec2 aligned_at(const Turn& turn) {
  const IntervalVec2& c = turn.order.heading;
  const double kr = turn.sign * turn.shape.turn_radius_m;
  return {turn.centre_m.x + kr * c.y, turn.centre_m.y - kr * c.x};
}

inline bool is_inside(const IntervalVec2& p, double cell_m) {
  return p.x.lo > 0.0 && p.x.hi < cell_m && p.y.lo > 0.0 && p.y.hi < cell_m;
}

/// The states that have turned to the command at `at`, straight on.
inline void leave_aligned(const Turn& turn, const IntervalVec2& at, CellDepartures& departures) {
  const double d = turn.shape.cell_m;
  const IntervalVec2 inside{intersection(at.x, {0.0, d}), intersection(at.y, {0.0, d})};
  if (inside.x.empty() || inside.y.empty()) return;
  CellDeparture leave;
  leave.heading = turn.order.heading;
  leave.aligned = true;
  leave.length_m =
      above(turn.shape.turn_radius_m * angle_bound(turn.entry.heading, turn.order.heading));
  leave_straight(inside, leave, turn.shape, departures);
}

/// All departures of one turn.
inline void leave_turning(const Turn& turn, CellDepartures& departures) {
  const double r = turn.shape.turn_radius_m;
  if (turn.must_align && keeps_quadrant(turn.entry.heading, turn.order.heading)) {
    // x and y are monotone along the arc: it stays inside when its end does.
    const IntervalVec2 at = aligned_at(turn);
    if (is_inside(at, turn.shape.cell_m)) {
      leave_aligned(turn, at, departures);
      return;
    }
  }
  ShortList<ArcEvent, 5> events;
  if (turn.may_align) {
    ArcEvent& align = events.grow();
    align.heading = turn.order.heading;
    align.certain = turn.must_align;
    align.possible = true;
  }
  for (const Side side : {Side::right, Side::top, Side::left, Side::bottom}) {
    // Every heading on an arc of at most 90 degrees is a sum of its ends with weights >= 0, that
    // of the last > 0 except at the start: it never points out of a side when the first end does
    // not and the last points in. (A touch at the very start is the business of the caller.)
    const double k = turn.sign;
    const Interval first = outward_part(turn.entry.heading, side);
    const Interval last = turn.must_align ? outward_part(turn.order.heading, side)
                                          : with_sign(is_far(side) ? k : -k,
                                                      is_vertical(side) ? -turn.entry.heading.y
                                                                        : turn.entry.heading.x);
    if (first.hi <= 0.0 && last.negative()) continue;
    ArcEvent& event = events.grow();
    crossing(turn, side, event);
    if (!event.possible && !event.certain) events.drop_last();
  }
  for (int i = 0; i < events.size(); ++i) {
    const ArcEvent& event = events[i];
    bool first = event.possible;
    for (int j = 0; j < events.size() && first; ++j) {
      const ArcEvent& other = events[j];
      if (j == i || !other.certain) continue;
      first = !with_sign(turn.sign, cross(other.heading, event.heading)).positive();
    }
    if (!first) continue;
    if (turn.may_align && i == 0) {
      leave_aligned(turn, aligned_at(turn), departures);
      continue;
    }
    if (departures.of.is_full()) {
      departures.too_wide = true;
      return;
    }
    CellDeparture& leave = departures.of.grow();
    leave.side = event.side;
    leave.along_m = event.along_m;
    leave.low_corner = event.low_corner;
    leave.high_corner = event.high_corner;
    leave.heading = event.heading;
    leave.turn = turn.sign;
    leave.centre_m = event.centre_m;
    leave.length_m = above(r * angle_bound(turn.entry.heading, event.heading));
  }
}

inline void turn_and_leave(const CellEntry& entry, const CellOrder& order, const CellShape& shape,
                           int sign, bool may_align, bool must_align, CellDepartures& departures) {
  Turn turn{entry, order, shape, sign, may_align, must_align, entry.centre_m};
  if (entry.turn != sign) {
    const double kr = sign * shape.turn_radius_m;
    turn.centre_m = {entry.position_m.x - kr * entry.heading.y,
                     entry.position_m.y + kr * entry.heading.x};  // (a)
  }
  leave_turning(turn, departures);
}

}  // namespace cell_enclosure

/// Every way in which a state of `entry` can leave the cell under `order`.
inline CellDepartures enclose_departures(const CellEntry& entry, const CellOrder& order,
                                         const CellShape& shape) {
  CellDepartures departures;
  if (entry.heading.x.width() > 0.5 || entry.heading.y.width() > 0.5) {
    departures.too_wide = true;
    return departures;
  }
  if (!order.has_command || order.already_there) {
    CellDeparture straight;
    straight.heading = entry.heading;
    straight.aligned = order.has_command;
    cell_enclosure::leave_straight(entry.position_m, straight, shape, departures);
    return departures;
  }
  const Interval side = cross(entry.heading, order.heading);
  const Interval ahead = dot(entry.heading, order.heading);
  const bool near = ahead.hi > 0.0;
  const bool sure = ahead.lo > 0.0;
  if (side.positive() || side.negative()) {
    cell_enclosure::turn_and_leave(entry, order, shape, side.positive() ? 1 : -1, near, sure,
                                   departures);
  } else if (near && !sure) {
    departures.too_wide = true;
  } else {  // aligned, or opposite: each turn for the states that take it
    cell_enclosure::turn_and_leave(entry, order, shape, 1, near, sure, departures);
    cell_enclosure::turn_and_leave(entry, order, shape, -1, near, sure, departures);
  }
  return departures;
}

}  // namespace fairway
