#include "check/motion.hpp"

#include <algorithm>
#include <array>

namespace fairway_check {
namespace {

const Real side_range(-0.5, 0.5);
const Real unit_range(-1.0, 1.0);
constexpr double diagonal = 1.4143;  // > sqrt(2)

/// An upper bound of the angle between unit vectors of two sets, less than 180 degrees: four times
/// the arc tangent of the tangent of its quarter, from the series up to a positive term.
double largest_angle(const Vec& a, const Vec& b) {
  const Real cosine(std::clamp(dot(a, b).lower(), -1.0, 1.0));
  const Real t = root((1.0 - cosine) * 0.5) / (1.0 + root((1.0 + cosine) * 0.5));
  const Real s = square(t);
  const Real series = 945.0 - s * (315.0 - s * (189.0 - s * (135.0 - s * 105.0)));
  return (4.0 * t * series / 945.0).upper();
}

/// Headings on arcs of less than 180 degrees from `first` to `last`. A component goes from its
/// value at one end to that at the other unless the arc passes its axis, which it does not while
/// the other component keeps its sign.
Vec headings_between(const Vec& first, const Vec& last) {
  return {positive(first.y * last.y) ? hull(first.x, last.x) : unit_range,
          positive(first.x * last.x) ? hull(first.y, last.y) : unit_range};
}

/// The part of (x, y) that may be a unit vector with x >= 0; false when empty.
bool keep_on_circle(Vec& heading) {
  if (!cut(heading.x, root(1.0 - square(heading.y)))) return false;
  const Real size = root(1.0 - square(heading.x));
  return !(positive(heading.y) && !cut(heading.y, size)) &&
         !(negative(heading.y) && !cut(heading.y, -size));
}

/// Cuts the place at the corners; false when nothing is left.
bool keep_between_corners(Way& way) {
  way.at_low = !(way.place.lower() > -0.5);
  way.at_high = !(way.place.upper() < 0.5);
  return cut(way.place, side_range);
}

/// Straight on from `at`; every way is `like` except for where it leaves.
bool go_straight(const Vec& at, const Way& like, std::vector<Way>& ways) {
  for (int side = 0; side < 4; ++side) {
    const Vec u = into_frame(side, like.heading);
    if (negative(u.x)) continue;
    const Vec p = into_frame(side, at);
    Real gap = 0.5 - p.x;
    if (!cut(gap, Real(0.0, 1.0))) continue;
    Way way = like;
    way.side = side;
    double length = diagonal;
    if (positive(u.x)) {
      way.place = p.y + gap * (u.y / u.x);
      length = std::min(length, (gap / u.x).upper());
    } else {  // along the side, or towards it at a very small angle
      if (gap.lower() > 0.0 && u.x.upper() == 0.0) continue;
      way.skims = true;
      const Real until = gap.lower() > 0.0 ? Real(gap.lower()) / u.x.upper() : Real(0.0);
      const double ahead = u.y.lower() > 0.5 ? 1.0 : u.y.upper() < -0.5 ? -1.0 : 0.0;
      if (ahead == 0.0) return false;
      const Real from = ahead * (p.y + until * u.y);
      way.place = ahead * Real(std::min(from.lower(), 1.0), 1.0);  // and further, to the side's end
    }
    // Until it leaves, it stays between the side's ends.
    if (positive(u.y)) length = std::min(length, ((0.5 - p.y) / u.y).upper());
    if (negative(u.y)) length = std::min(length, ((-0.5 - p.y) / u.y).upper());
    if (!keep_between_corners(way)) continue;
    // A state running exactly on the side reaches its end together with the side ahead: see there.
    if (is_zero(u.x)) way.at_low = way.at_high = false;
    way.length = (Real(like.length) + length).upper();
    ways.push_back(way);
  }
  return true;
}

struct Arc {
  Vec start;     // headings there
  Vec headings;  // all that occur before alignment and within 90 degrees
  Vec centre;
  double k;  // the sign
  Real kr;
  Real radius;
};

/// One of the events that may end an arc.
struct Event {
  Way way;
  bool possible = false;  // it may be the first event of some state
  bool sure = false;      // every state meets it within 90 degrees, unless another comes first, ...
  Vec heading;            // ... with one of these headings
};

Event crossing(const Arc& arc, int side) {
  Event event;
  Way& way = event.way;
  Vec centre = into_frame(side, arc.centre);
  Vec u{Real(0.0), (0.5 - centre.x) / arc.kr};  // k / R is 1 / (k R)
  const bool surely_crosses = u.y.lower() > -1.0 && u.y.upper() < 1.0;
  if (!cut(u.y, unit_range)) return event;
  u.x = root(1.0 - square(u.y));
  event.heading = from_frame(side, u);
  const Real turned = arc.k * cross(arc.start, event.heading);
  const Real ahead = dot(arc.start, event.heading);
  if (negative(turned) || negative(ahead)) return event;
  event.sure = surely_crosses && turned.lower() >= 0.0 && positive(ahead);

  const Vec headings = into_frame(side, arc.headings);
  if (!cut(u.x, headings.x) || !cut(u.y, headings.y) || !keep_on_circle(u)) return event;
  way.place = centre.y - arc.kr * u.x;
  if (!keep_between_corners(way)) return event;
  if (way.at_low || way.at_high) {  // only the headings that leave between the corners
    if (!cut(u.x, (centre.y - way.place) / arc.kr) || !keep_on_circle(u)) return event;
  }
  if (!cut(centre.y, way.place + arc.kr * u.x) || !cut(centre.x, 0.5 - arc.kr * u.y)) return event;
  event.possible = true;
  way.side = side;
  way.turn = arc.k > 0.0 ? 1 : -1;
  way.heading = from_frame(side, u);
  way.centre = from_frame(side, centre);
  way.length = (arc.radius * largest_angle(arc.start, way.heading)).upper();
  return event;
}

bool align_and_go(const Arc& arc, const Vec& command, Vec at, std::vector<Way>& ways) {
  if (!cut(at.x, side_range) || !cut(at.y, side_range)) return true;
  const double length = (arc.radius * largest_angle(arc.start, command)).upper();
  return go_straight(at, {.aligned = true, .heading = command, .length = length}, ways);
}

/// `ahead`: the cosines of the angles to the command.
bool go_turning(const Bundle& set, const Vec& command, int sign, const Real& ahead,
                const Real& radius, std::vector<Way>& ways) {
  const bool will_align = positive(ahead);  // if it stays that long
  const double k = sign;
  const Real kr = k * radius;
  const Vec& u = set.heading;
  const Vec last = will_align ? command : Vec{-(k * u.y), k * u.x};
  const Vec centre = set.turn == sign ? set.centre : Vec{set.at.x - kr * u.y, set.at.y + kr * u.x};
  const Arc arc{u, headings_between(u, last), centre, k, kr, radius};
  const Vec at{centre.x + kr * command.y, centre.y - kr * command.x};  // when aligned
  // No state's component changes sign on the way if no product of its first and last is below 0.
  const auto runs_one_way_inside = [](const Real& first, const Real& end, const Real& place) {
    return (first * end).lower() >= 0.0 && place.lower() > -0.5 && place.upper() < 0.5;
  };
  if (will_align && runs_one_way_inside(u.x, command.x, at.x) &&
      runs_one_way_inside(u.y, command.y, at.y)) {
    return align_and_go(arc, command, at, ways);
  }
  std::array<Event, 5> events;  // the last one: aligning
  for (int side = 0; side < 4; ++side) {
    // If neither of two headings points out of a side, none between them does.
    if (into_frame(side, u).x.upper() <= 0.0 && negative(into_frame(side, last).x)) continue;
    events[static_cast<std::size_t>(side)] = crossing(arc, side);
  }
  events[4].heading = events[4].way.heading = command;
  events[4].possible = ahead.upper() > 0.0;
  events[4].sure = will_align;
  for (const Event& event : events) {
    const bool first = std::none_of(events.begin(), events.end(), [&](const Event& other) {
      return other.sure && positive(k * cross(other.heading, event.way.heading));
    });
    if (!event.possible || !first) continue;
    if (&event != &events[4]) {
      ways.push_back(event.way);
    } else if (!align_and_go(arc, command, at, ways)) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool find_ways(const Bundle& set, const Command& command, const Real& radius,
               std::vector<Way>& ways) {
  if (width(set.heading.x) > 0.5 || width(set.heading.y) > 0.5) return false;
  if (!command.exists || command.is_flown) {
    return go_straight(set.at, {.aligned = command.exists, .heading = set.heading}, ways);
  }
  const Real left = cross(set.heading, command.heading);
  const Real ahead = dot(set.heading, command.heading);
  const bool one_side = positive(left) || negative(left);
  if (!one_side && !positive(ahead) && !negative(ahead)) return false;
  // Both turns where either is possible: aligned, or opposite.
  return (negative(left) || go_turning(set, command.heading, 1, ahead, radius, ways)) &&
         (positive(left) || go_turning(set, command.heading, -1, ahead, radius, ways));
}

}  // namespace fairway_check
