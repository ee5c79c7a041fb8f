#include "check/motion.hpp"

#include <algorithm>

namespace fairway_check {
namespace {

const Real side_range(-0.5, 0.5);
const Real unit_range(-1.0, 1.0);
constexpr double diagonal = 1.4143;  // > sqrt(2)

/// An upper bound of the angle between unit vectors of two sets, less than 180 degrees: four times
/// the arc tangent of the tangent of its quarter, by the series up to a positive term.
double largest_angle(const Vec& a, const Vec& b) {
  const Real cosine(std::clamp(dot(a, b).lower(), -1.0, 1.0));
  const Real t = root((1.0 - cosine) * 0.5) / (1.0 + root((1.0 + cosine) * 0.5));
  const Real s = square(t);
  const Real series = 945.0 - s * (315.0 - s * (189.0 - s * (135.0 - s * 105.0)));
  return (4.0 * t * series / 945.0).upper();
}

/// Headings on arcs of less than 180 degrees from `first` to `last`. One component runs from end to
/// end unless the arc passes its axis, which it does not while the other one keeps its sign.
Vec headings_between(const Vec& first, const Vec& last) {
  const auto same_sign = [](const Real& a, const Real& b) {
    return (positive(a) && positive(b)) || (negative(a) && negative(b));
  };
  return {same_sign(first.y, last.y) ? hull(first.x, last.x) : unit_range,
          same_sign(first.x, last.x) ? hull(first.y, last.y) : unit_range};
}

/// What of (x, y) may be a unit vector with x >= 0; false when nothing.
bool keep_on_circle(Vec& heading) {
  if (!cut(heading.x, root(1.0 - square(heading.y)))) return false;
  const Real size = root(1.0 - square(heading.x));
  if (positive(heading.y)) return cut(heading.y, size);
  if (negative(heading.y)) return cut(heading.y, -size);
  return true;
}

/// Straight on from `at`; every way is `like` but for where it leaves.
void go_straight(const Vec& at, const Way& like, Ways& ways) {
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
    } else {  // beside the side, or towards it under a very small angle
      if (gap.lower() > 0.0 && u.x.upper() == 0.0) continue;
      way.skims = true;
      const Real until = gap.lower() > 0.0 ? Real(gap.lower()) / u.x.upper() : Real(0.0);
      if (u.y.lower() > 0.5) {
        const double from = (p.y.lower() + until * u.y.lower()).lower();
        if (from > 0.5) continue;
        way.place = {from, 0.5};
      } else if (u.y.upper() < -0.5) {
        const double from = (p.y.upper() + until * u.y.upper()).upper();
        if (from < -0.5) continue;
        way.place = {-0.5, from};
      } else {
        ways.lost = true;
        return;
      }
    }
    // What runs exactly on the side comes to its end together with the side ahead: told there.
    way.at_low = !is_zero(u.x) && !(way.place.lower() > -0.5);
    way.at_high = !is_zero(u.x) && !(way.place.upper() < 0.5);
    if (!cut(way.place, side_range)) continue;
    way.length = (Real(like.length) + length).upper();
    ways.add(way);
  }
}

bool is_inside(const Real& place) { return place.lower() > -0.5 && place.upper() < 0.5; }

struct Arc {
  const Bundle& from;
  int sign;
  Vec centre;
  Vec headings;  // all that may occur before alignment and within 90 degrees
  Real radius;
};

/// One of the events that may end an arc.
struct Event {
  Vec heading;
  bool possible = false;  // as the first event of some state
  bool sure = false;      // every state meets it within 90 degrees, unless another comes first
  Way way;
};

Event crossing(const Arc& arc, int side) {
  Event event;
  const Real kr = static_cast<double>(arc.sign) * arc.radius;
  Vec centre = into_frame(side, arc.centre);
  Vec u{Real(0.0), (0.5 - centre.x) / kr};  // k / R is 1 / (k R)
  event.sure = u.y.lower() > -1.0 && u.y.upper() < 1.0;
  if (!cut(u.y, unit_range)) return event;
  u.x = root(1.0 - square(u.y));
  event.heading = from_frame(side, u);
  const Real turned = static_cast<double>(arc.sign) * cross(arc.from.heading, event.heading);
  const Real ahead = dot(arc.from.heading, event.heading);
  if (negative(turned) || negative(ahead)) return {};
  event.sure = event.sure && turned.lower() >= 0.0 && positive(ahead);

  const Vec headings = into_frame(side, arc.headings);
  if (!cut(u.x, headings.x) || !cut(u.y, headings.y) || !keep_on_circle(u)) return event;
  Way& way = event.way;
  way.side = side;
  way.place = centre.y - kr * u.x;
  way.at_low = !(way.place.lower() > -0.5);
  way.at_high = !(way.place.upper() < 0.5);
  if (!cut(way.place, side_range)) return event;
  if (way.at_low || way.at_high) {  // only the headings that leave between the corners
    if (!cut(u.x, (centre.y - way.place) / kr) || !keep_on_circle(u)) return event;
  }
  if (!cut(centre.y, way.place + kr * u.x) || !cut(centre.x, 0.5 - kr * u.y)) return event;
  event.possible = true;
  event.heading = way.heading = from_frame(side, u);
  way.centre = from_frame(side, centre);
  way.turn = arc.sign;
  return event;
}

/// Where the arc reaches the command `c`.
Vec aligned_at(const Arc& arc, const Vec& c) {
  const Real kr = static_cast<double>(arc.sign) * arc.radius;
  return {arc.centre.x + kr * c.y, arc.centre.y - kr * c.x};
}

void turn_then_straight(const Arc& arc, const Vec& c, Vec at, Ways& ways) {
  if (!cut(at.x, side_range) || !cut(at.y, side_range)) return;
  Way like;
  like.heading = c;
  like.aligned = true;
  like.length = (arc.radius * largest_angle(arc.from.heading, c)).upper();
  go_straight(at, like, ways);
}

void go_turning(const Bundle& set, const Vec& command, int sign, bool may_align, bool will_align,
                const Real& radius, Ways& ways) {
  const Real kr = static_cast<double>(sign) * radius;
  const Vec& u = set.heading;
  const double k = sign;
  const Vec last = will_align ? command : Vec{-(k * u.y), k * u.x};
  const Arc arc{set, sign,
                set.turn == sign ? set.centre : Vec{set.at.x - kr * u.y, set.at.y + kr * u.x},
                headings_between(u, last), radius};
  const auto one_way = [](const Real& a, const Real& b) {
    return (a.lower() >= 0.0 && b.lower() >= 0.0) || (a.upper() <= 0.0 && b.upper() <= 0.0);
  };
  const Vec at = aligned_at(arc, command);
  if (will_align && one_way(u.x, command.x) && one_way(u.y, command.y) && is_inside(at.x) &&
      is_inside(at.y)) {
    // On the whole arc x runs one way, and y: it leaves the cell nowhere before its end.
    turn_then_straight(arc, command, at, ways);
    return;
  }
  std::array<Event, 5> events;
  std::size_t count = 0;
  if (may_align) {
    events[count].heading = command;
    events[count].possible = true;
    events[count++].sure = will_align;
  }
  for (int side = 0; side < 4; ++side) {
    // Between two headings there is none that points out of a side of which neither does.
    if (into_frame(side, u).x.upper() <= 0.0 && negative(into_frame(side, last).x)) continue;
    const Event event = crossing(arc, side);
    if (event.possible || event.sure) events[count++] = event;
  }
  for (std::size_t i = 0; i < count; ++i) {
    bool first = events[i].possible;
    for (std::size_t j = 0; j < count && first; ++j) {
      first =
          j == i || !events[j].sure || !positive(k * cross(events[j].heading, events[i].heading));
    }
    if (!first) continue;
    if (may_align && i == 0) {
      turn_then_straight(arc, command, at, ways);
    } else {
      events[i].way.length = (radius * largest_angle(u, events[i].heading)).upper();
      ways.add(events[i].way);
    }
  }
}

}  // namespace

void find_ways(const Bundle& set, const Command& command, const Real& radius, Ways& ways) {
  if (width(set.heading.x) > 0.5 || width(set.heading.y) > 0.5) {
    ways.lost = true;
    return;
  }
  if (!command.exists || command.is_flown) {
    Way like;
    like.heading = set.heading;
    like.aligned = command.exists;
    go_straight(set.at, like, ways);
    return;
  }
  const Real left = cross(set.heading, command.heading);
  const Real ahead = dot(set.heading, command.heading);
  const bool may_align = ahead.upper() > 0.0;
  const bool will_align = ahead.lower() > 0.0;
  if (!positive(left) && !negative(left) && may_align && !will_align) {
    ways.lost = true;
    return;
  }
  for (const int sign : {1, -1}) {  // both where it may be either: aligned, or opposite
    if (sign > 0 ? negative(left) : positive(left)) continue;
    go_turning(set, command.heading, sign, may_align, will_align, radius, ways);
  }
}

}  // namespace fairway_check
