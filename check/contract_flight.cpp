#include "check/contract_flight.hpp"

#include <algorithm>
#include <array>
#include <numbers>

namespace fairway_check {
namespace {

using std::numbers::pi;

constexpr double most_step = 2.5 * pi / 180.0;
constexpr double most_joining = 2.5 * pi / 180.0;  ///< headings of a set that begins
constexpr double most_turned = 8.0 * pi;
constexpr int most_work = 1 << 14;
constexpr std::size_t most_waiting = 4096;
constexpr std::size_t few_waiting = 64;
constexpr double most_parts_met = 4096.0;
constexpr double largest_radius = 0x1p12;
/// How deep those that touch a part from outside may lie in it; and how far beyond its sides those
/// may lie that are followed in it: the same, so that no one is left out and no one is in both.
constexpr double skin = 1.5 * touch;
constexpr double blur = 0x1p-40;  ///< of a comparison with it
constexpr double part_diagonal = std::numbers::sqrt2 * (1.0 + 8.0 * touch);

Verdict verdict_in(CellKind kind) {
  return kind == target ? reach : kind == obstacle ? collide : leave;
}
Point unit(double rad) { return {std::cos(rad), std::sin(rad)}; }
Box box_of(Cell part) {
  return {static_cast<double>(part.x), static_cast<double>(part.y), part.x + 1.0, part.y + 1.0};
}
Shape moved(const Shape& at, Point by) {
  Shape all;
  for (const Point p : at.corners()) all.add(p + by);
  return all;
}
/// With all corners moved into the box, from at most `blur` beyond it.
Shape within(const Shape& at, const Box& box) {
  Shape all;
  for (const Point p : at.corners()) {
    all.add({std::clamp(p.x, box.x0, box.x1), std::clamp(p.y, box.y0, box.y1)});
  }
  return all;
}
Point corner_of(Cell part) { return {static_cast<double>(part.x), static_cast<double>(part.y)}; }

/// Restricts where an aligned set leaves over a side, if no heading (middle +- half) goes the other
/// way along it.
void keep_sure(Cell part, int side, double middle, double half, const Box& sure, double& low,
               double& high) {
  const double off = std::abs(std::remainder(middle - (side + 1) * (0.5 * pi), 2.0 * pi));
  const double x0 = sure.x0 - part.x;
  const double x1 = sure.x1 - part.x;
  const double y0 = sure.y0 - part.y;
  const double y1 = sure.y1 - part.y;
  const double from[4]{y0, 1.0 - x1, 1.0 - y1, x0};
  const double to[4]{y1, 1.0 - x0, 1.0 - y0, x1};
  if (off + half <= 0.5 * pi) low = std::max(low, from[side]);
  if (off - half >= 0.5 * pi) high = std::min(high, to[side]);
}

/// All displacements in a step of the clock. With the radius r between r1 and r2 the displacement
/// is the integral of r e over the headings, so that of r1, an arc within the triangle of its
/// tangents, and (r2 - r1) times something in the parallelogram of the same tangents.
struct Displacements {
  Displacements(int turn, double clock, double step, double least_radius, double most_radius) {
    const double tangent = std::tan(0.5 * step);
    const Point first = tangent * unit(turn * clock);
    const Point last = tangent * unit(turn * (clock + step));
    const Point chord = first + last;
    const double spread = most_radius - least_radius;
    whole = least_radius * chord;
    const Point far = least_radius * chord;
    const Point bend = least_radius * first;
    const Shape arc = turn > 0 ? Shape{{0.0, 0.0}, bend, far} : Shape{{0.0, 0.0}, far, bend};
    if (spread > 0.0) {
      const Point a = spread * first;
      const Point b = spread * last;
      slack = turn > 0 ? Shape{{0.0, 0.0}, a, a + b, b} : Shape{{0.0, 0.0}, b, a + b, a};
    } else {
      slack = Shape{{0.0, 0.0}};
    }
    partial = sum(arc, slack);
  }
  Point whole{};  ///< of the whole step, to which `slack` is added
  Shape slack{};
  Shape partial{};  ///< of any part of the step
};

}  // namespace

/// Adjacent headings from which a set turns to one side alike.
struct Behaviours::Run {
  int turn;
  double least = 0.0;
  double most = 0.0;
  Memory memory{};
};

Past Past::with(double least, double most, double further, double turn) const {
  return {std::min(least_rad, least), std::max(most_rad, most), length + further, turned + turn};
}

Behaviours::Behaviours(const Parts& parts, const Contract& contract)
    : parts_(parts),
      contract_(contract),
      least_radius_(contract.least_radius / parts.side_m),
      most_radius_(contract.most_radius / parts.side_m),
      roaming_rad_(std::asin(part_diagonal / least_radius_) + angle_slack) {}

void Behaviours::lose() {
  if (!lost_) sightings_->give_up();
  lost_ = true;
  waiting_.clear();
}

/// Calls for every part that `at` comes within `margin` of, with what lies there; by rows.
template <typename Visit>
void Behaviours::for_parts(const Shape& at, double margin, Visit visit) const {
  const Box all = at.bounds();
  const auto first = [margin](double low) { return static_cast<int>(std::floor(low - margin)); };
  const auto last = [margin](double high) { return static_cast<int>(std::floor(high + margin)); };
  for (int y = first(all.y0); y <= last(all.y1); ++y) {
    const Shape row = clipped(at, Box{-HUGE_VAL, y - margin, HUGE_VAL, y + 1.0 + margin});
    if (row.empty()) continue;
    const Box in_row = row.bounds();
    for (int x = first(in_row.x0); x <= last(in_row.x1); ++x) {
      const Shape there = clipped(row, box_of({x, y}).grown(margin));
      if (!there.empty()) visit(Cell{x, y}, there);
    }
  }
}

void Behaviours::touch_ends(const Shape& at, const Past& past) {
  for_parts(at, touch, [&](Cell part, const Shape&) {
    const CellKind kind = kind_of(part);
    if (kind != ordinary) sightings_->end(verdict_in(kind), past);
  });
}

void Behaviours::follow_leaf(std::size_t part, int side, double low, double high,
                             Sightings& sightings) {
  sightings_ = &sightings;
  lost_ = false;
  work_ = 0;
  origin_ = parts_.part_at(part);
  const Arc arc = parts_.arc[part];
  double least = arc.right;
  double most = arc.right + arc.width;
  if (parts_.kind[part] != ordinary || is_loose(arc, contract_)) return lose();
  if (!point_outwards(side, least, most)) return;
  // Near the ends of a wide arc a side may be held: the one that leads into the arc. (Those that
  // hold the other one have turned that way without pause, and are followed as such.)
  const double far_left = arc.right + arc.width - contract_.hold_side + angle_slack;
  const double far_right = arc.right + contract_.hold_side - angle_slack;
  const double to_left = std::clamp(far_left, least, most);
  const double to_right = std::clamp(far_right, to_left, most);
  const Shape at = places_on(side, low, high);
  const Box sure = at.bounds();
  const Past past = Past{}.with(least, most, 0.0, 0.0);
  const Memory none{.nothing = true, .side = false};
  const Memory any{.nothing = true, .side = true};
  const Cell beyond = Cell{0, 0}.beyond(side);
  if (to_left > least) begin(beyond, at, least, to_left, any, none, sure, past);
  if (to_right > to_left || least == most)
    begin(beyond, at, to_left, to_right, none, none, sure, past);
  if (most > to_right) begin(beyond, at, to_right, most, none, any, sure, past);
  run(sightings);
}

void Behaviours::follow_state(std::size_t part, double x, double y, double heading_rad,
                              Sightings& sightings) {
  sightings_ = &sightings;
  lost_ = false;
  work_ = 0;
  origin_ = parts_.part_at(part);
  const Memory memory{.nothing = true, .side = false};
  begin({0, 0}, Shape{{x, y}}, heading_rad, heading_rad, memory, memory, everywhere,
        Past{}.with(heading_rad, heading_rad, 0.0, 0.0));
  run(sightings);
}

void Behaviours::run(Sightings& sightings) {
  if (!(most_radius_ <= largest_radius)) lose();
  while (!waiting_.empty() && !sightings.has_enough()) {
    Turning set = waiting_.back();
    waiting_.pop_back();
    while (!lost_ && !sightings.has_enough() && advance(set)) {
    }
    if (returns_.size() + waiting_.size() > most_waiting) lose();
    for (const Return& one : returns_) waiting_.push_back(one.set);
    returns_.clear();
  }
  waiting_.clear();
}

/// States in a part (or on its border, about to enter) with headings in [least, most].
void Behaviours::begin(Cell part, const Shape& at, double least, double most, Memory left,
                       Memory right, const Box& sure, const Past& past) {
  touch_ends(at, past);
  if (kind_of(part) != ordinary || lost_ || sightings_->has_enough()) return;
  if (++work_ > most_work) return lose();
  const Arc arc = arc_of(part);
  if (is_loose(arc, contract_)) return roam(part, at, least, most, past);

  // Between these headings the choices are the same.
  std::array<double, turning_points + 2> cuts;
  std::size_t count = 0;
  cuts[count++] = least;
  double points[turning_points];
  find_turning_points(arc.right, arc.width, contract_, points);
  for (const double point : points) {
    const double cut = least + around_from(point - least);
    if (cut > least + angle_slack && cut < most - angle_slack) cuts[count++] = cut;
  }
  cuts[count++] = most;
  std::sort(cuts.begin(), cuts.begin() + static_cast<std::ptrdiff_t>(count));
  bool aligns = false;
  std::array<Run, 2> runs{Run{.turn = 1}, Run{.turn = -1}};
  const auto finish = [&](Run& run) {
    if (run.memory.any()) turn_from(at, run.turn, run.least, run.most, run.memory, sure, past);
    run.memory = {};
  };
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double low = cuts[i];
    const double step = cuts[i + 1] - low;
    const double end = arc.right + arc.width;
    const std::array<Choices, 2> choices{
        choices_in(arc.right, arc.width, low, step, left, contract_),
        choices_in(-end, arc.width, -low - step, step, right, contract_)};
    if (choices[0].aligns && !aligns) align(part, at, true, sure, low + 0.5 * step, past);
    aligns = aligns || choices[0].aligns;
    const bool alternates = choices[0].alternates || choices[1].alternates;
    if (alternates) roam(part, at, low, low + step, past);
    for (std::size_t k = 0; k < 2; ++k) {
      const Memory now = alternates ? Memory{} : choices[k].on;
      if (now.nothing != runs[k].memory.nothing || now.side != runs[k].memory.side) {
        finish(runs[k]);
        runs[k].least = low;
        runs[k].memory = now;
      }
      runs[k].most = low + step;
    }
  }
  for (Run& run : runs) finish(run);
}

void Behaviours::turn_from(const Shape& at, int turn, double least, double most, Memory memory,
                           const Box& sure, const Past& past) {
  const double count = std::max(1.0, std::ceil((most - least) / most_joining));
  if (waiting_.size() > most_waiting) return lose();
  for (double i = 0.0; i < count; ++i) {
    const double low = least + (most - least) * (i / count);
    const double high = least + (most - least) * ((i + 1.0) / count);
    waiting_.push_back({.at = at,
                        .joining = at,
                        .turn = turn,
                        .clock = turn > 0 ? low : -high,
                        .joined = turn > 0 ? high : -low,
                        .memory = memory,
                        .past = past.with(low, high, 0.0, 0.0),
                        .sure = sure});
  }
}

/// Those that turn back in one part in adjacent steps make one set: the last step is its first.
void Behaviours::turn_back(const Turning& set, double end, Cell part, const Shape& there,
                           Memory memory, const Past& past) {
  for (Return& one : returns_) {
    Turning& back = one.set;
    if (one.part.x != part.x || one.part.y != part.y || back.clock != -set.clock ||
        back.memory.nothing != memory.nothing || back.memory.side != memory.side ||
        back.joined + end > most_joining) {
      continue;
    }
    back.clock = -end;
    back.at = back.joining = hull(back.at, there);
    back.past.least_rad = std::min(back.past.least_rad, past.least_rad);
    back.past.most_rad = std::max(back.past.most_rad, past.most_rad);
    back.past.length = std::max(back.past.length, past.length);
    back.past.turned = std::max(back.past.turned, past.turned);
    back.sure = {std::min(back.sure.x0, set.sure.x0), std::min(back.sure.y0, set.sure.y0),
                 std::max(back.sure.x1, set.sure.x1), std::max(back.sure.y1, set.sure.y1)};
    return;
  }
  returns_.push_back({part,
                      {.at = there,
                       .joining = there,
                       .turn = -set.turn,
                       .clock = -end,
                       .joined = -set.clock,
                       .memory = memory,
                       .past = past,
                       .sure = set.sure}});
}

/// Aligned in a part, `heading` among the headings. The way in the cone of its arc is shorter than
/// what it gains along the middle of the cone, divided by the cosine of half its width.
void Behaviours::align(Cell part, const Shape& at, bool begins, const Box& sure, double heading,
                       const Past& past) {
  const Arc arc = arc_of(part);
  const double right = heading - around_from(heading - arc.right);
  const double middle_rad = right + 0.5 * arc.width;
  const Point middle = unit(middle_rad);
  const bool exact = begins && sure.x0 > -HUGE_VAL;
  const double length =
      (1.0 + 8.0 * touch) * (std::abs(middle.x) + std::abs(middle.y)) / std::cos(0.5 * arc.width);
  const Past then = past.with(right, right + arc.width, length, 0.0);
  const Shape inside = moved(at, -1.0 * corner_of(part));
  for (int side = 0; side < 4; ++side) {
    double low = 0.0;
    double high = 0.0;
    if (find_way_out(inside, side, right, right + arc.width, exact, low, high)) {
      keep_sure(part, side, middle_rad, 0.5 * arc.width, sure, low, high);
      sightings_->cross(parts_.index(global(part)), side, low, high, then);
    }
  }
}

/// A curve of radius r1 or more that has turned by n < 90 degrees has come forward by r1 sin n.
void Behaviours::roam(Cell part, const Shape& at, double least, double most, const Past& past) {
  const double low_rad = least - roaming_rad_;
  const double high_rad = most + roaming_rad_;
  if (!(high_rad - low_rad < pi - 0x1p-20)) return lose();  // also NaN
  const double length = part_diagonal / std::cos(0.5 * (high_rad - low_rad));
  const Past then = past.with(low_rad, high_rad, length, roaming_rad_);
  if (then.turned > most_turned) return lose();
  const Shape inside = moved(at, -1.0 * corner_of(part));
  for (int side = 0; side < 4; ++side) {
    double low = 0.0;
    double high = 0.0;
    if (!find_way_out(inside, side, low_rad, high_rad, false, low, high)) continue;
    double from = low_rad;
    double to = high_rad;
    if (!point_outwards(side, from, to)) continue;
    const Memory any{.nothing = true, .side = true};
    begin(part.beyond(side), moved(places_on(side, low, high), corner_of(part)), from, to, any, any,
          everywhere, then);
  }
}

/// The step to the next heading at which an arc begins or ends in any part that might be met.
double Behaviours::step_before_changes(const Turning& set, const Box& swept, double step) const {
  double least = step;
  const int last_x = static_cast<int>(std::floor(swept.x1 + skin));
  const int last_y = static_cast<int>(std::floor(swept.y1 + skin));
  for (int y = static_cast<int>(std::floor(swept.y0 - skin)); y <= last_y; ++y) {
    for (int x = static_cast<int>(std::floor(swept.x0 - skin)); x <= last_x; ++x) {
      if (kind_of({x, y}) != ordinary) continue;
      const Arc arc = arc_of({x, y});
      if (is_loose(arc, contract_)) continue;
      double points[turning_points];
      find_turning_points(set.turn > 0 ? arc.right : -(arc.right + arc.width), arc.width, contract_,
                          points);
      for (const double point : points) {
        const double until = around_from(point - set.clock);
        if (until > angle_slack) least = std::min(least, until);
      }
    }
  }
  return least;
}

/// One step of the clock; false: nobody turns on.
bool Behaviours::advance(Turning& set) {
  if (++work_ > most_work || set.past.turned > most_turned) {
    lose();
    return false;
  }
  double step = (std::floor(set.clock / (0.5 * pi) + 0x1p-30) + 1.0) * (0.5 * pi) - set.clock;
  const bool joins = set.joined - set.clock > 0x1p-32;
  step = std::min({step, most_step, joins ? set.joined - set.clock : HUGE_VAL});
  Displacements by(set.turn, set.clock, step, least_radius_, most_radius_);
  Shape swept = sum(set.at, by.partial);
  const Box all = swept.bounds();
  if ((all.x1 - all.x0 + 1.0) * (all.y1 - all.y0 + 1.0) > most_parts_met) {
    lose();
    return false;
  }
  const double sooner = step_before_changes(set, all, step);
  if (sooner < step) {
    step = sooner;
    by = Displacements(set.turn, set.clock, step, least_radius_, most_radius_);
    swept = sum(set.at, by.partial);
  }
  const Point middle = unit(set.turn * (set.clock + 0.5 * step));  // all are in its quadrant
  (middle.x > 0.0 ? set.sure.x1 : set.sure.x0) = middle.x > 0.0 ? HUGE_VAL : -HUGE_VAL;
  (middle.y > 0.0 ? set.sure.y1 : set.sure.y0) = middle.y > 0.0 ? HUGE_VAL : -HUGE_VAL;
  const double end = set.clock + step;
  const Past past = set.turn > 0 ? set.past.with(set.clock, end, most_radius_ * step, step)
                                 : set.past.with(-end, -set.clock, most_radius_ * step, step);
  Memory memory = joins ? set.memory : Memory{};
  meet(set, step, swept, past, memory);
  const bool stays =
      joins || std::any_of(met_.begin(), met_.end(), [](const Met& m) { return m.stays; });
  if (!stays || lost_) return false;
  set.at = sum(set.at, by.slack, by.whole);
  if (joins) set.at = hull(set.at, sum(set.joining, by.partial));
  set.clock = end;
  set.past = past;
  if (memory.any()) set.memory = memory;  // else it has only left parts behind
  return joins || part_from(set);
}

void Behaviours::meet(const Turning& set, double step, const Shape& swept, const Past& past,
                      Memory& memory) {
  met_.clear();
  near_.clear();
  for_parts(swept, skin + blur, [&](Cell part, const Shape& there) {
    const auto begins_in = [&](const Shape& at) {
      return !at.empty() && !clipped(at, box_of(part).grown(skin + blur)).empty();
    };
    const bool ends = kind_of(part) != ordinary;
    near_.push_back({part, there, ends || begins_in(set.at) || begins_in(set.joining)});
  });
  // Nobody comes behind obstacles but over sides of other parts: through the corner where two
  // obstacles meet, one touches both. (A convex set over such a corner does not show it.)
  for (bool more = true; more;) {
    more = false;
    for (Near& to : near_) {
      if (to.is_reached) continue;
      to.is_reached = std::any_of(near_.begin(), near_.end(), [&](const Near& from) {
        return from.is_reached && kind_of(from.part) == ordinary &&
               std::abs(from.part.x - to.part.x) + std::abs(from.part.y - to.part.y) == 1;
      });
      more = more || to.is_reached;
    }
  }
  for (const Near& n : near_) {
    if (!lost_ && n.is_reached) {
      meet_part(set, step, n.part, within(n.there, box_of(n.part).grown(skin)), past, memory);
    }
  }
}

/// What happens to those that are in `part` during the step. `memory`: what may be remembered by
/// those that turn on is added.
void Behaviours::meet_part(const Turning& set, double step, Cell part, const Shape& there,
                           const Past& past, Memory& memory) {
  const CellKind kind = kind_of(part);
  if (kind != ordinary) {
    if (clipped(there, box_of(part).grown(touch)).empty()) return;
    sightings_->end(verdict_in(kind), past);
    met_.push_back({part, false});
    return;
  }
  // Those that only touch a side from within and move outwards are in the part beyond it.
  const Box all = there.bounds();
  const double depth[4]{part.x + 1.0 - all.x0, part.y + 1.0 - all.y0, all.x1 - part.x,
                        all.y1 - part.y};
  const double end = set.clock + step;
  for (int side = 0; side < 4; ++side) {
    const auto outwards = [&](double clock) {
      return std::cos(set.turn * clock - side * (0.5 * pi));
    };
    if (depth[side] <= skin + blur && outwards(set.clock) >= -0x1p-40 &&
        outwards(end) >= -0x1p-40) {
      // There they are followed, unless they move along the side, so that the part beyond says the
      // same of this one, or touch an obstacle from farther away than it tells of.
      const bool clearly = std::max(outwards(set.clock), outwards(end)) > 0x1p-30;
      met_.push_back({part, !clearly || kind_of(part.beyond(side)) != ordinary});
      return;
    }
  }
  const double least = set.turn > 0 ? set.clock : -end;
  const Arc arc = arc_of(part);
  if (is_loose(arc, contract_)) {
    met_.push_back({part, false});
    return roam(part, there, least, least + step, past);
  }
  const Choices c = choices_in(set.turn > 0 ? arc.right : -(arc.right + arc.width), arc.width,
                               set.clock, step, set.memory, contract_);
  if (c.aligns) align(part, there, false, set.sure, least + 0.5 * step, past);
  if (c.alternates) {
    met_.push_back({part, false});
    return roam(part, there, least, least + step, past);
  }
  if (c.turns_back) turn_back(set, end, part, there, c.back, past);
  met_.push_back({part, c.goes_on});
  if (!c.goes_on) return;
  memory.nothing = memory.nothing || c.on.nothing;
  memory.side = memory.side || c.on.side;
}

/// Leaves out places in parts where nobody turns on: what is left is divided into rectangles of
/// parts. False: nothing is left.
bool Behaviours::part_from(Turning& set) {
  const bool none_lost = std::all_of(met_.begin(), met_.end(), [&](const Met& m) {
    return m.stays || clipped(set.at, box_of(m.part).grown(-skin - blur)).empty();
  });
  if (none_lost) return true;
  const bool many = waiting_.size() > few_waiting;  // then they stay one set
  const Shape whole = set.at;
  bool first = true;
  for (std::size_t i = 0; i < met_.size();) {
    std::size_t next = i + 1;
    if (met_[i].stays) {
      while (next < met_.size() && met_[next].stays && met_[next].part.y == met_[i].part.y &&
             met_[next].part.x == met_[next - 1].part.x + 1) {
        ++next;
      }
      Box run = box_of(met_[i].part);
      run.x1 = met_[next - 1].part.x + 1.0;
      const Shape left = clipped(whole, run.grown(skin + blur));
      if (!left.empty()) {
        if (!first && !many) waiting_.push_back(set);
        set.at = first || !many ? left : hull(set.at, left);
        set.joining.clear();
        set.joined = set.clock;
        first = false;
      }
    }
    i = next;
  }
  return !first;
}

}  // namespace fairway_check
