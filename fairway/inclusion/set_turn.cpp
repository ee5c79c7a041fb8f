// The turn of a set: the heading is the clock.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fairway/inclusion/part_pieces.hpp"
#include "fairway/inclusion/set_flight.hpp"

namespace fairway {

/// How far a heading lies beyond the arc's beginning, counted the way of the turn: aligned up to
/// the arc's width; beyond, commands lie behind the turn's back, from x - width to x away.
double SetFlight::beyond(const HeadingArc& arc, double heading_rad, Turn turn) {
  return turn == Turn::left ? counted_from_zero(heading_rad - arc.lo_rad)
                            : counted_from_zero(arc.hi_rad() - heading_rad);
}

/// `starting`: some begin to turn during the step. Such a part of an arc is a sum of headings
/// within it, so it lies in the parallelogram of the tangents, but not in the triangle.
SetFlight::Step SetFlight::step_from(const ConvexSet& set, double begin_rad, double size_rad,
                                     Turn side, bool starting) const {
  const double end_rad = begin_rad + static_cast<int>(side) * size_rad;
  // Tangents of the unit arc meet at this distance from its ends; the arc lies in their triangle.
  const double tangent = std::tan(0.5 * size_rad);
  const Vec2 first{tangent * std::cos(begin_rad), tangent * std::sin(begin_rad)};
  const Vec2 second{tangent * std::cos(end_rad), tangent * std::sin(end_rad)};
  const Vec2 chord = first + second;
  const auto [least, most] = parts_.turn_radius();
  // Of any radius: the triangle of the least, and what more of it adds.
  const double more = most - least;
  const std::array<Vec2, 5> swept{Vec2{}, most * first, most * chord, least * chord + more * second,
                                  more * second};
  const std::array<Vec2, 4> ends{least * chord, least * chord + more * first, most * chord,
                                 least * chord + more * second};
  const bool to_left = side == Turn::left;
  Step step{begin_rad, size_rad, {}, {}};
  const std::array<Vec2, 4> parts_of_arcs{Vec2{}, most * first, most * chord, most * second};
  step.swept = starting
                   ? sum(set, ConvexSet::of_ordered(parts_of_arcs, to_left))
                   : sum(set, ConvexSet::of_ordered({swept.data(), more > 0.0 ? 5U : 3U}, to_left));
  step.ends = ConvexSet::of_ordered({ends.data(), more > 0.0 ? 4U : 1U}, to_left);
  return step;
}

/// Puts what the step sweeps into parts. How far on the first arc of one of them begins or ends;
/// its own size, if none.
double SetFlight::first_edge(const Step& step, Turn side) {
  double least = step.size_rad;
  pieces_.clear();
  for_parts(parts_, step.swept, [&](PartPlace p, PartKind kind, const ConvexSet& piece) {
    pieces_.push_back({p, kind, piece});
    if (kind != PartKind::ordinary) return;
    const HeadingArc& arc = parts_.arc(p);
    for (const double edge : {arc.lo_rad, arc.hi_rad()}) {
      const double on = counted_from_zero(static_cast<int>(side) * (edge - step.begin_rad));
      if (on > drop_slack_rad) least = std::min(least, on);
    }
  });
  return least;
}

/// Behaviours of successive steps that go the same way from a part fly on as one set, as long as
/// their headings are about the same: many small sets would not tell more.
void SetFlight::gather(std::vector<Gathered>& sets, PartPlace part, const ConvexSet& piece,
                       const HeadingArc& headings, const Past& past) {
  constexpr double most_apart_rad = 0.3;
  const auto found = std::find_if(sets.begin(), sets.end(), [&](const Gathered& g) {
    return g.part.ix == part.ix && g.part.iy == part.iy &&
           std::max(g.arriving.hi_rad, headings.hi_rad()) -
                   std::min(g.arriving.lo_rad, headings.lo_rad) <
               most_apart_rad;
  });
  if (found == sets.end()) {
    sets.push_back({part, {piece, headings.lo_rad, headings.hi_rad(), past}});
    return;
  }
  ArrivingSet& set = found->arriving;
  std::vector<Vec2> corners(set.set.corners().begin(), set.set.corners().end());
  corners.insert(corners.end(), piece.corners().begin(), piece.corners().end());
  set.set = ConvexSet::hull(corners);
  set.lo_rad = std::min(set.lo_rad, headings.lo_rad);
  set.hi_rad = std::max(set.hi_rad, headings.hi_rad());
  set.past = past;  // it holds that of earlier steps
}

void SetFlight::turn(const TurningSet& set) {
  const ArrivingSet& from = set.from;
  const int sign = static_cast<int>(set.turn);
  const double hold = parts_.hold_side_rad();
  const double opposite = pi + parts_.side_uncertain_rad();
  double at = set.turn == Turn::left ? from.lo_rad : from.hi_rad;
  const double last = set.turn == Turn::left ? from.hi_rad : from.lo_rad;
  const auto still_to = [&](double heading) { return sign * (last - heading); };
  ConvexSet here = from.set;
  Past past = from.past;
  past.flown +=
      parts_.turn_radius().most * options_.step_rad;  // who checks may begin a step sooner
  bool forgot = false;                                // some may hold no side any more
  std::vector<Gathered> back;                         // what turns back
  while (!is_over()) {
    if (++steps_ > options_.most_steps || sign * (at - from.lo_rad) > 3.0 * whole_turn_rad) {
      image_.gave_up = true;
      return;
    }
    const bool more_start = still_to(at) > drop_slack_rad;
    double size = options_.step_rad;
    if (more_start) size = std::min(size, still_to(at));
    Step step = step_from(here, at, size, set.turn, more_start);
    for (double edge; (edge = first_edge(step, set.turn)) < size;) {
      step = step_from(here, at, size = edge, set.turn, more_start);
    }
    const double end = at + sign * size;
    const HeadingArc these{std::min(at, end), size};
    past.headings = past.headings.with(these);
    past.flown += parts_.turn_radius().most * size;

    // No edge lies within the step: its middle is aligned as all of it.
    const auto behind = [&](const HeadingArc& arc) {
      return beyond(arc, at + 0.5 * sign * size, set.turn);
    };
    const double off = 0.5 * size + heading_slack_rad;
    // Commands less than `hold` away make it forget the side: on its way to a part, wherever.
    for (const auto& [p, kind, piece] : pieces_) {
      if (kind != PartKind::ordinary) continue;
      const HeadingArc& arc = parts_.arc(p);
      const double x = behind(arc);
      forgot |= x - off - arc.width_rad <= hold || x + off >= whole_turn_rad - hold;
    }
    for (const auto& [p, kind, piece] : pieces_) {
      if (kind == PartKind::wild) {
        image_.gave_up = true;
        return;
      }
      if (ends_there(kind)) {
        image_.flown = std::max(image_.flown, past.flown);
        continue;
      }
      note(p, these);
      const HeadingArc& arc = parts_.arc(p);
      if (arc.widened(align_slack_rad).meets(these)) align(p, piece, past, 16.0 * place_slack);
      const double x = behind(arc);
      if (x <= arc.width_rad) continue;
      if (x - off - arc.width_rad <= (forgot ? opposite : hold)) {  // a command on the other side
        gather(back, p, piece, these, past);
      }
    }

    // Who turns on at the end of the step.
    const ConvexSet there = more_start ? step.swept : sum(here, step.ends);
    // In the same parts: whoever is left out as aligned with one was told of as that above.
    const auto turns_on = [&](const PartPiece& there_in) {
      if (there_in.kind != PartKind::ordinary) return false;
      const HeadingArc& arc = parts_.arc(there_in.part);
      const double x = beyond(arc, end, set.turn);
      const bool aligned =
          x <= arc.width_rad + heading_slack_rad || x >= whole_turn_rad - heading_slack_rad;
      const bool ahead = !aligned && whole_turn_rad - x <= opposite + heading_slack_rad;
      const bool held = x >= hold - heading_slack_rad && x < whole_turn_rad - drop_slack_rad;
      return ahead || held;
    };
    if (std::all_of(pieces_.begin(), pieces_.end(), turns_on)) {
      here = there;  // which holds the start as long as it is needed
    } else {
      on_.clear();
      for (const PartPiece& piece : pieces_) {
        if (!turns_on(piece)) continue;
        const ConvexSet part = more_start ? piece.piece : there.within(grown_box(piece.part));
        on_.insert(on_.end(), part.corners().begin(), part.corners().end());
      }
      if (still_to(end) > drop_slack_rad) {
        on_.insert(on_.end(), from.set.corners().begin(), from.set.corners().end());
      }
      if (on_.empty()) break;
      here = ConvexSet::hull(on_);
    }
    at = end;
  }
  for (const Gathered& g : back) turning_.push_back({g.arriving, other(set.turn)});
}

}  // namespace fairway
