// Flying a set of states until every one of them is accounted for.
//
// The section is the set of states in which the vehicle leaves an ordinary cell with exactly the
// cell's own command as its heading. It is one-dimensional, because headings align exactly and in
// finite time, and almost every flight soon meets it: what a plan does with all states follows from
// what it does with those of the section, plus one short flight.
//
// The flight is followed as an enclosure, cell by cell, and branches where the set does. What
// happens to the states is reported to a visitor:
//     void arrive(std::size_t section, Interval along_m, double length_m, bool hop)  on the section
//     void end(Verdict, double length_m)      in a target or obstacle cell, outside, or circling
//     void give_up()   too wide, too long or too many pieces; the reports are incomplete
// length_m bounds the length flown so far.
//
// Properties that always hold, when cell_m < turn_radius_m:
//   1. Every state of the start meets one of the things reported, with its place inside the
//      interval reported: no state is lost. Something is always reported.
//   2. On contact with a corner every cell around it is reported; heading along a border, both.
//   3. `end(trapped)` is reported only for states on a circle that comes back to the same border
//      through the same cells without aligning: motion on a circle repeats.
//   4. A `hop` is one wave of a weave: out over a border and back, on two arcs, to the section of
//      the start. Both arcs depend only on the command and the border's direction, so all states
//      of the start were moved along the border by the same distance.
// A section is named 4 * cell + side.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "fairway/base/short_list.hpp"
#include "fairway/vehicle/cell_enclosure.hpp"
#include "fairway/verify/flight_memory.hpp"
#include "fairway/verify/flow.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

/// A set of states in one cell, with what can be concluded from its flight so far.
struct Front {
  int ix = 0;
  int iy = 0;
  CellEntry entry;
  float heading_rad = NAN;  ///< the exact heading, when it is some cell's command
  double length_m = 0.0;
  flight_memory::Hop hop;
  flight_memory::Wave wave;
  flight_memory::Circle circle;
  /// Runs straight along this side, as does the same set in the cell beyond it.
  int grazed = -1;
};

namespace section_flight {

inline int step_x(Side s) { return s == Side::right ? 1 : s == Side::left ? -1 : 0; }
inline int step_y(Side s) { return s == Side::top ? 1 : s == Side::bottom ? -1 : 0; }
inline Side opposite(Side s) { return static_cast<Side>((static_cast<int>(s) + 2) & 3); }

/// The command of a cell for states whose heading is exactly `tag` (NaN: not known exactly).
inline CellOrder order_for(float command, float tag) {
  CellOrder order;
  order.has_command = !std::isnan(command);
  order.already_there = command == tag;
  if (order.has_command) order.heading = unit_enclosure(static_cast<double>(command));
  return order;
}

template <typename Visitor>
class Follower {
 public:
  Follower(const Flow& flow, int most_crossings, Visitor& visitor)
      : flow_(flow), shape_(flow.shape()), most_crossings_(most_crossings), visitor_(visitor) {}

  void push(const Front& front) {
    if (!fronts_.add(front)) gave_up_ = true;
  }
  void run() {
    for (int crossings = 0; !fronts_.empty() && !gave_up_; ++crossings) {
      const Front front = fronts_.take();
      gave_up_ = crossings == most_crossings_;
      if (!gave_up_) cross(front);
    }
    if (gave_up_) visitor_.give_up();
  }

 private:
  static constexpr int most_fronts = 16;

  void cross(const Front& front) {
    const std::size_t cell = flow_.grid.index({front.ix, front.iy});
    const float command = flow_.heading_rad[cell];
    const CellOrder order = order_for(command, front.heading_rad);
    const CellDepartures departures = enclose_departures(front.entry, order, shape_);
    if (departures.too_wide || departures.count() == 0) {
      gave_up_ = true;
      return;
    }
    for (const CellDeparture& leave : departures) {
      if (leave.grazes && static_cast<int>(leave.side) == front.grazed) continue;
      Crossing crossing{front, cell, section_of(cell, leave.side), leave, departures.count() == 1};
      depart(crossing, order.has_command ? (leave.aligned ? command : NAN) : front.heading_rad);
    }
  }

  /// A set on its way out of a cell.
  struct Crossing {
    const Front& from;
    std::size_t cell;    // left
    std::size_t border;  // crossed, as a section of that cell
    CellDeparture leave;
    bool sole;  // all states of the front leave this way
  };

  void depart(Crossing& crossing, float tag) {
    const Front& from = crossing.from;
    CellDeparture& leave = crossing.leave;
    const bool hop = flight_memory::comes_back_as_the_command(from.hop, crossing.border);
    if (hop && leave.aligned) return;  // aligning and leaving are one event, reported once
    if (hop) {
      tag = flow_.heading_rad[crossing.cell];
      leave.aligned = true;
      leave.turn = 0;
    }
    Front next;
    next.ix = from.ix + step_x(leave.side);
    next.iy = from.iy + step_y(leave.side);
    next.entry.heading = leave.heading;
    next.heading_rad = tag;
    next.length_m = above(from.length_m + leave.length_m);
    corner(next, leave, from, leave.low_corner, -1);
    corner(next, leave, from, leave.high_corner, +1);

    const CellKind kind = flow_.kind_at({next.ix, next.iy});
    if (kind != CellKind::ordinary) {
      visitor_.end(verdict_of(kind), next.length_m);
      return;
    }
    if (leave.grazes && turns_back(next, leave.heading, leave.side)) return;
    if (leave.aligned && !leave.grazes) {
      visitor_.arrive(crossing.border, leave.along_m, next.length_m, hop);
      return;
    }
    if (leave.turn != 0 && !turns_on(crossing, next)) return;
    if (leave.grazes) next.grazed = static_cast<int>(opposite(leave.side));
    const double line = cell_enclosure::is_far(leave.side) ? 0.0 : shape_.cell_m;
    next.entry.position_m = cell_enclosure::from_parts(line, leave.along_m, leave.side);
    push(next);
  }

  /// Over the border on an arc: updates what is remembered about arcs. False when the circle is
  /// closed, which is reported.
  bool turns_on(Crossing& crossing, Front& next) {
    const Front& from = crossing.from;
    CellDeparture& leave = crossing.leave;
    const std::size_t back = section_of(flow_.grid.index({next.ix, next.iy}), opposite(leave.side));
    const double until_here_m = next.length_m;
    ride_waves(crossing, back, next);
    const flight_memory::Circle circle =
        from.entry.turn == leave.turn ? from.circle : flight_memory::Circle{};
    if (flight_memory::is_closed(circle, crossing.border)) {
      visitor_.end(Verdict::trapped, until_here_m);
      return false;
    }
    next.circle = flight_memory::after_turning_over(circle, crossing.border);
    next.hop = flight_memory::after_turning_over(from.hop, back);
    next.entry.turn = leave.turn;
    next.entry.centre_m = leave.centre_m - IntervalVec2{step_x(leave.side) * shape_.cell_m,
                                                        step_y(leave.side) * shape_.cell_m};
    return true;
  }

  /// A weave over one border with two arcs per wave keeps its angle n to the border; each wave
  /// moves every state by 4 r sin n, and so does the next, as long as it lands between the same two
  /// cells (only the place along the border differs). Waves that certainly do are skipped in one
  /// step.
  void ride_waves(Crossing& crossing, std::size_t back, Front& next) {
    const flight_memory::Wave& wave = crossing.from.wave;
    CellDeparture& leave = crossing.leave;
    if (crossing.sole && !wave.half && wave.began == back) {
      next.wave = wave;
      next.wave.half = true;
      return;
    }
    if (!crossing.sole || !wave.half || wave.began != crossing.border) {
      next.wave = {crossing.border, next.length_m, false};
      return;
    }
    const Side side = leave.side;
    const double d = shape_.cell_m;
    const Interval step =
        (4.0 * shape_.turn_radius_m) *
        intersection(cell_enclosure::outward_part(leave.heading, side), {0.0, 1.0});
    const Interval onwards = cell_enclosure::along(leave.heading, side);
    const double room = onwards.positive() ? d - leave.along_m.hi : leave.along_m.lo;
    const double waves = std::floor(room / step.hi) - 2.0;
    if ((!onwards.positive() && !onwards.negative()) || !(waves >= 1.0) || waves >= 0x1p40) return;
    const Interval move = (onwards.positive() ? waves : -waves) * step;
    leave.along_m = intersection(leave.along_m + move, {0.0, d});
    leave.centre_m =
        cell_enclosure::from_parts(cell_enclosure::across(leave.centre_m, side),
                                   cell_enclosure::along(leave.centre_m, side) + move, side);
    next.length_m = above(next.length_m + above(waves * (next.length_m - wave.length_m)));
  }

  /// The states that leave through the corner at the low (-1) or high (+1) end of the side touch
  /// two more cells: the neighbour of the cell left, and the one they enter across the corner.
  void corner(Front next, const CellDeparture& leave, const Front& front, bool there, int end) {
    if (!there) return;
    const Interval onwards = cell_enclosure::along(leave.heading, leave.side);
    if (end > 0 ? onwards.negative() : onwards.positive()) return;
    const bool vertical = cell_enclosure::is_vertical(leave.side);
    const int beside_x = front.ix + (vertical ? 0 : end);
    const int beside_y = front.iy + (vertical ? end : 0);
    next.ix += vertical ? 0 : end;
    next.iy += vertical ? end : 0;
    for (const CellKind kind :
         {flow_.kind_at({beside_x, beside_y}), flow_.kind_at({next.ix, next.iy})}) {
      if (kind != CellKind::ordinary) visitor_.end(verdict_of(kind), next.length_m);
    }
    if (flow_.kind_at({next.ix, next.iy}) != CellKind::ordinary) return;
    if (turns_back(next, leave.heading, towards(vertical, end))) return;
    const double d = shape_.cell_m;
    const double line = cell_enclosure::is_far(leave.side) ? 0.0 : d;
    next.entry.position_m = cell_enclosure::from_parts(line, end > 0 ? 0.0 : d, leave.side);
    push(next);
  }

  /// Heading exactly along the side through which they would enter, into a cell whose command turns
  /// out of it again: no motion stays in that cell for any length of time.
  bool turns_back(const Front& next, const IntervalVec2& heading, Side side) const {
    const Interval into = cell_enclosure::outward_part(heading, side);
    if (into.lo != 0.0 || into.hi != 0.0) return false;
    const float command = flow_.heading_rad[flow_.grid.index({next.ix, next.iy})];
    return !std::isnan(command) &&
           cell_enclosure::outward_part(unit_enclosure(static_cast<double>(command)), side)
               .negative();
  }
  static Side towards(bool vertical, int end) {
    return vertical ? (end > 0 ? Side::top : Side::bottom) : (end > 0 ? Side::right : Side::left);
  }

  static Verdict verdict_of(CellKind kind) {
    return kind == CellKind::target     ? Verdict::reach
           : kind == CellKind::obstacle ? Verdict::collide
                                        : Verdict::leave;
  }

  const Flow& flow_;
  CellShape shape_;
  int most_crossings_;
  Visitor& visitor_;
  ShortList<Front, most_fronts> fronts_;
  bool gave_up_ = false;
};

}  // namespace section_flight

/// Whether a side of a cell has states of the section: an ordinary cell, a command that points out
/// of that side, and an ordinary cell beyond it.
inline bool is_section(const Flow& flow, std::size_t section) {
  const Side side = static_cast<Side>(section % 4);
  const Cell cell = flow.grid.cell_at(section / 4);
  const Cell beyond{cell.ix + section_flight::step_x(side), cell.iy + section_flight::step_y(side)};
  const float command = flow.heading_rad[section / 4];
  return flow.kind_at(cell) == CellKind::ordinary && !std::isnan(command) &&
         flow.kind_at(beyond) == CellKind::ordinary &&
         cell_enclosure::outward_part(unit_enclosure(static_cast<double>(command)), side)
             .positive();
}

/// Follows `start` in an ordinary cell through at most `most_crossings` cells, counting branches.
template <typename Visitor>
void follow_to_section(const Flow& flow, const Front& start, int most_crossings, Visitor& visitor) {
  section_flight::Follower<Visitor> follower(flow, most_crossings, visitor);
  follower.push(start);
  follower.run();
}

/// The states of the section `4 * cell + side` whose place along the side is in `along_m`, on their
/// way into the next cell, which is ordinary.
inline Front front_of_section(const Flow& flow, std::size_t section, Interval along_m) {
  const std::size_t cell = section / 4;
  const Side side = static_cast<Side>(section % 4);
  Front front;
  front.ix = static_cast<int>(cell % static_cast<std::size_t>(flow.grid.nx)) +
             section_flight::step_x(side);
  front.iy = static_cast<int>(cell / static_cast<std::size_t>(flow.grid.nx)) +
             section_flight::step_y(side);
  const double line = cell_enclosure::is_far(side) ? 0.0 : flow.grid.cell_m;
  front.entry.position_m = cell_enclosure::from_parts(line, along_m, side);
  front.heading_rad = flow.heading_rad[cell];
  front.entry.heading = unit_enclosure(static_cast<double>(front.heading_rad));
  front.hop.came_off = section;
  return front;
}

}  // namespace fairway
