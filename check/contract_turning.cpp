#include "check/contract_turning.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "check/contract_displacements.hpp"

namespace fairway_check {
namespace {

using std::numbers::pi;

constexpr double most_step = 2.5 * pi / 180.0;
/// While some begin to turn, when the set widens with the square of the step.
constexpr double finer_step = 0.5 * most_step;
constexpr double most_joining = 2.5 * pi / 180.0;  ///< headings of a set that begins
constexpr std::size_t most_waiting = 4096;
constexpr std::size_t few_waiting = 64;
constexpr double most_parts_met = 4096.0;
constexpr double largest_radius = 0x1p12;

}  // namespace

void TurningSets::add(const Shape& at, int turn, double least, double most, Memory memory,
                      const Box& sure, const Past& past) {
  const double count = std::max(1.0, std::ceil((most - least) / most_joining));
  if (waiting_.size() > most_waiting) return following_.lose();
  for (double i = 0.0; i < count; ++i) {
    const double low = least + (most - least) * (i / count);
    const double high = least + (most - least) * ((i + 1.0) / count);
    Turning& set = waiting_.emplace_back();
    set.at = set.joining = at;
    set.turn = turn;
    set.clock = turn > 0 ? low : -high;
    set.joined = turn > 0 ? high : -low;
    set.memory = memory;
    set.past = past.with(low, high, 0.0, 0.0);
    set.sure = sure;
  }
}

void TurningSets::follow() {
  if (!(following_.most_radius() <= largest_radius)) following_.lose();
  while (!waiting_.empty() && !following_.is_over()) {
    Turning set = waiting_.back();
    waiting_.pop_back();
    while (!following_.is_over() && advance(set)) {
    }
    if (returns_.size() + waiting_.size() > most_waiting) following_.lose();
    for (const Return& one : returns_) waiting_.push_back(one.set);
    returns_.clear();
  }
  waiting_.clear();
}

/// The step to the next heading at which an arc begins or ends in any part that might be met.
double TurningSets::step_before_changes(const Turning& set, const Box& swept, double step) const {
  double least = step;
  const int last_x = static_cast<int>(std::floor(swept.x1 + skin));
  const int last_y = static_cast<int>(std::floor(swept.y1 + skin));
  for (int y = static_cast<int>(std::floor(swept.y0 - skin)); y <= last_y; ++y) {
    for (int x = static_cast<int>(std::floor(swept.x0 - skin)); x <= last_x; ++x) {
      if (following_.kind_of({x, y}) != ordinary) continue;
      const Arc arc = following_.arc_of({x, y});
      if (is_loose(arc, following_.contract())) continue;
      double points[turning_points];
      find_turning_points(set.turn > 0 ? arc.right : -(arc.right + arc.width), arc.width,
                          following_.contract(), points);
      for (const double point : points) {
        const double until = around_from(point - set.clock);
        if (until > angle_slack) least = std::min(least, until);
      }
    }
  }
  return least;
}

/// One step of the clock; false: nobody turns on.
bool TurningSets::advance(Turning& set) {
  if (set.past.turned > most_turned) following_.lose();
  if (!following_.spend()) return false;
  double step = (std::floor(set.clock / (0.5 * pi) + 0x1p-30) + 1.0) * (0.5 * pi) - set.clock;
  const bool joins = set.joined - set.clock > 0x1p-32;
  step =
      std::min({step, joins ? finer_step : most_step, joins ? set.joined - set.clock : HUGE_VAL});
  Displacements by(set.turn, set.clock, step, following_.least_radius(), following_.most_radius());
  const Box at = set.at.bounds();
  const Box way = (joins ? by.begun : by.partial).bounds();
  const Box all{at.x0 + way.x0, at.y0 + way.y0, at.x1 + way.x1, at.y1 + way.y1};
  if ((all.x1 - all.x0 + 1.0) * (all.y1 - all.y0 + 1.0) > most_parts_met) following_.lose();
  if (following_.is_lost()) return false;
  const double sooner = step_before_changes(set, all, step);
  if (sooner < step) {
    step = sooner;
    by = Displacements(set.turn, set.clock, step, following_.least_radius(),
                       following_.most_radius());
  }
  const Shape swept = sum(set.at, joins ? by.begun : by.partial);
  const Point middle = unit(set.turn * (set.clock + 0.5 * step));  // all are in its quadrant
  (middle.x > 0.0 ? set.sure.x1 : set.sure.x0) = middle.x > 0.0 ? HUGE_VAL : -HUGE_VAL;
  (middle.y > 0.0 ? set.sure.y1 : set.sure.y0) = middle.y > 0.0 ? HUGE_VAL : -HUGE_VAL;
  const double end = set.clock + step;
  const Past past = set.turn > 0
                        ? set.past.with(set.clock, end, following_.most_radius() * step, step)
                        : set.past.with(-end, -set.clock, following_.most_radius() * step, step);
  if (!joins && align_all(set, step, past)) return false;
  Memory memory = joins ? set.memory : Memory{};
  meet(set, step, swept, past, memory);
  const bool stays =
      joins || std::any_of(met_.begin(), met_.end(), [](const Met& m) { return m.stays; });
  if (!stays || following_.is_lost()) return false;
  set.at = sum(set.at, by.slack, by.whole);
  if (joins) set.at = hull(set.at, sum(set.joining, by.begun));
  set.clock = end;
  set.past = past;
  if (memory.any()) set.memory = memory;  // else it has only left parts behind
  return joins || part_from(set);
}

/// Whether all are in parts whose arcs hold their heading when the step begins: then nobody turns
/// on, and who would come to other parts during the step is told of as leaving these.
bool TurningSets::align_all(const Turning& set, double step, const Past& past) {
  const auto keep_arc = [&](Cell part) {
    return following_.kind_of(part) == ordinary &&
           keep_to(following_.arc_of(part), set.turn, set.clock, step, set.memory,
                   following_.contract());
  };
  // Mostly one place that is in no other part tells that it is not so.
  const Point one = set.at.corners().front();
  const Cell its = part_of(one);
  if (is_deep_in(one, its, 2.0 * skin) && !keep_arc(its)) return false;
  bool all = true;
  near_.clear();
  for_parts_while(set.at, skin + blur, [&](Cell part, const Shape& there) {
    const Shape in_part = within(there, box_of(part).grown(skin));
    if (is_followed_beyond(set, set.clock + step, part, in_part)) return true;
    all = keep_arc(part);
    if (all) near_.push_back({part, in_part, true});
    return all;
  });
  if (!all || near_.empty()) return false;
  const double least = set.turn > 0 ? set.clock : -(set.clock + step);
  for (const Near& n : near_) {
    following_.visit(n.part, least, least + step);
    following_.align(n.part, n.there, false, set.sure, least + 0.5 * step, past);
  }
  return true;
}

void TurningSets::meet(const Turning& set, double step, const Shape& swept, const Past& past,
                       Memory& memory) {
  met_.clear();
  near_.clear();
  for_parts(swept, skin + blur, [&](Cell part, const Shape& there) {
    const Box box = box_of(part).grown(skin + blur);
    const bool ends = following_.kind_of(part) != ordinary;
    near_.push_back({part, there, ends || meets(set.at, box) || meets(set.joining, box)});
  });
  // Nobody comes behind obstacles but over sides of other parts: through the corner where two
  // obstacles meet, one touches both. (A convex set over such a corner does not show it.)
  for (bool more = true; more;) {
    more = false;
    for (Near& to : near_) {
      if (to.is_reached) continue;
      to.is_reached = std::any_of(near_.begin(), near_.end(), [&](const Near& from) {
        return from.is_reached && following_.kind_of(from.part) == ordinary &&
               std::abs(from.part.x - to.part.x) + std::abs(from.part.y - to.part.y) == 1;
      });
      more = more || to.is_reached;
    }
  }
  for (const Near& n : near_) {
    if (!following_.is_lost() && n.is_reached) {
      meet_part(set, step, n.part, within(n.there, box_of(n.part).grown(skin)), past, memory);
    }
  }
}

/// Those that only touch a side from within and move outwards are in the part beyond it.
bool TurningSets::is_followed_beyond(const Turning& set, double end, Cell part,
                                     const Shape& there) {
  const Box all = there.bounds();
  const double depth[4]{part.x + 1.0 - all.x0, part.y + 1.0 - all.y0, all.x1 - part.x,
                        all.y1 - part.y};
  for (int side = 0; side < 4; ++side) {
    const auto outwards = [&](double clock) {
      return std::cos(set.turn * clock - side * (0.5 * pi));
    };
    if (depth[side] > skin + blur || outwards(set.clock) < -0x1p-40 || outwards(end) < -0x1p-40) {
      continue;
    }
    // There they are followed, unless they move along the side, so that the part beyond says the
    // same of this one, or touch an obstacle from farther away than it tells of.
    const bool clearly = std::max(outwards(set.clock), outwards(end)) > 0x1p-30;
    met_.push_back({part, !clearly || following_.kind_of(part.beyond(side)) != ordinary});
    return true;
  }
  return false;
}

/// What happens to those that are in `part` during the step. `memory`: what may be remembered by
/// those that turn on is added.
void TurningSets::meet_part(const Turning& set, double step, Cell part, const Shape& there,
                            const Past& past, Memory& memory) {
  const CellKind kind = following_.kind_of(part);
  if (kind != ordinary) {
    if (!meets(there, box_of(part).grown(touch))) return;
    following_.end_in(kind, past);
    met_.push_back({part, false});
    return;
  }
  const double end = set.clock + step;
  if (is_followed_beyond(set, end, part, there)) return;
  const double least = set.turn > 0 ? set.clock : -end;
  following_.visit(part, least, least + step);
  const Arc arc = following_.arc_of(part);
  if (is_loose(arc, following_.contract())) {
    met_.push_back({part, false});
    return roaming_.roam(part, there, least, least + step, past);
  }
  const Choices c = choices_in(set.turn > 0 ? arc.right : -(arc.right + arc.width), arc.width,
                               set.clock, step, set.memory, following_.contract());
  if (c.aligns) following_.align(part, there, false, set.sure, least + 0.5 * step, past);
  if (c.alternates) {
    met_.push_back({part, false});
    return roaming_.roam(part, there, least, least + step, past);
  }
  if (c.turns_back) turn_back(set, end, part, there, c.back, past);
  met_.push_back({part, c.goes_on});
  if (!c.goes_on) return;
  memory.nothing = memory.nothing || c.on.nothing;
  memory.side = memory.side || c.on.side;
}

/// Those that turn back in one part in adjacent steps make one set: the last step is its first.
void TurningSets::turn_back(const Turning& set, double end, Cell part, const Shape& there,
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
    back.past = back.past.joined(past);
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

/// Leaves out places in parts where nobody turns on: what is left is divided into rectangles of
/// parts. False: nothing is left.
bool TurningSets::part_from(Turning& set) {
  const bool none_lost = std::all_of(met_.begin(), met_.end(), [&](const Met& m) {
    return m.stays || !meets(set.at, box_of(m.part).grown(-skin - blur));
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
