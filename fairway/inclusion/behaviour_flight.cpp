#include "fairway/inclusion/behaviour_flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace fairway {
namespace {

/// The cosine to a side's outward heading below which slopes are not computed.
constexpr double least_outward = 0x1p-12;

// Headings so near an arc count as aligned, one tolerance inside the next: what is left out of a
// turn must have been told as aligned, whatever rounding did.
constexpr double align_slack_rad = heading_slack_rad;
constexpr double drop_slack_rad = 0.5 * heading_slack_rad;
constexpr double start_slack_rad = 0.25 * heading_slack_rad;

enum class Turn : int { left = 1, right = -1 };
constexpr Turn other(Turn side) { return side == Turn::left ? Turn::right : Turn::left; }

struct Axis {
  Vec2 outward;
  double heading_rad;
};
constexpr std::array<Axis, 4> axes{
    {{{1.0, 0.0}, 0.0}, {{0.0, 1.0}, 0.5 * pi}, {{-1.0, 0.0}, pi}, {{0.0, -1.0}, 1.5 * pi}}};

/// Behaviours that turn one way, from places where they begin to with headings [lo, hi].
struct TurningSet {
  ConvexSet from;
  double lo_rad = 0.0;
  double hi_rad = 0.0;
  Turn turn = Turn::left;
  HeadingArc had;  ///< headings before
  double flown = 0.0;
};

/// How far a heading lies beyond the arc's beginning, counted the way of the turn: aligned up to
/// the arc's width; beyond, commands lie behind the turn's back, from x - width to x away.
double beyond(const HeadingArc& arc, double heading_rad, Turn turn) {
  return turn == Turn::left ? counted_from_zero(heading_rad - arc.lo_rad)
                            : counted_from_zero(arc.hi_rad() - heading_rad);
}

class Flight {
 public:
  Flight(const Parts& parts, const BehaviourOptions& options, BehaviourImage& image)
      : parts_(parts), options_(options), image_(image) {}

  /// `from`: the arc of the part that the behaviours leave, null when they have no past.
  void start(PartPlace part, const ConvexSet& set, double lo, double hi, const HeadingArc* from);
  void finish();
  /// Ends what touches an obstacle or the outside at the start.
  void touch(const ConvexSet& set);

 private:
  /// One step of a turning set.
  struct Step {
    double begin_rad;
    double size_rad;
    std::array<Vec2, 4> spread;  // what radii between least and most add
    Vec2 chord;                  // of the least radius
    ConvexSet swept;
  };

  template <typename Body>
  void for_parts(const ConvexSet& set, const Body& body) const;
  void align(PartPlace part, const ConvexSet& set, const HeadingArc& had, double flown);
  void add_turning(const ConvexSet& set, HeadingArc starts, HeadingArc wanted, Turn turn);
  void turn(const TurningSet& set);
  Step step_from(const ConvexSet& set, double begin_rad, double size_rad, Turn turn) const;
  double first_edge(const Step& step, Turn turn) const;

  const Parts& parts_;
  const BehaviourOptions& options_;
  BehaviourImage& image_;
  std::vector<TurningSet> turning_;
  int steps_ = 0;
};

bool is_flown_over(PartKind kind) { return kind == PartKind::ordinary || kind == PartKind::wild; }

/// Calls body(part, kind, piece) for parts that together hold the set. A part over which behaviours
/// fly is left out when the set only touches it, and lies within the slack of others there.
template <typename Body>
void Flight::for_parts(const ConvexSet& set, const Body& body) const {
  Vec2 lowest = set.corners().front();
  Vec2 highest = lowest;
  for (const Vec2 p : set.corners()) {
    lowest = {std::min(lowest.x, p.x), std::min(lowest.y, p.y)};
    highest = {std::max(highest.x, p.x), std::max(highest.y, p.y)};
  }
  const auto below = [](double v) { return static_cast<int>(std::floor(v - place_slack)); };
  const auto above = [](double v) { return static_cast<int>(std::floor(v + place_slack)); };
  const int x0 = below(lowest.x);
  const int y0 = below(lowest.y);
  const int x1 = above(highest.x);
  const int y1 = above(highest.y);
  if (x0 == x1 && y0 == y1) {
    body(PartPlace{x0, y0}, parts_.kind({x0, y0}), set);
    return;
  }
  const auto piece = [&](PartPlace p, double grown) {
    return set.within({p.ix - grown, p.iy - grown}, {p.ix + 1 + grown, p.iy + 1 + grown});
  };
  std::vector<PartPlace> chosen;
  std::vector<PartPlace> touched;
  const auto choose = [&](PartPlace p, PartKind kind) {
    body(p, kind, piece(p, place_slack));
    if (is_flown_over(kind)) chosen.push_back(p);
  };
  for (int iy = y0; iy <= y1; ++iy) {
    for (int ix = x0; ix <= x1; ++ix) {
      const PartPlace p{ix, iy};
      const PartKind kind = parts_.kind(p);
      const bool inner = is_flown_over(kind);
      if (!piece(p, inner ? -place_slack : place_slack).empty()) {
        choose(p, kind);
      } else if (inner) {
        touched.push_back(p);
      }
    }
  }
  for (const PartPlace p : touched) {
    const ConvexSet sliver = piece(p, 0.0);
    const auto holds_it = [&](PartPlace q) {
      return std::all_of(sliver.corners().begin(), sliver.corners().end(), [&](Vec2 c) {
        return c.x >= q.ix - place_slack && c.x <= q.ix + 1 + place_slack &&
               c.y >= q.iy - place_slack && c.y <= q.iy + 1 + place_slack;
      });
    };
    if (!sliver.empty() && std::none_of(chosen.begin(), chosen.end(), holds_it)) {
      choose(p, parts_.kind(p));
    }
  }
}

/// Aligned behaviours leave the part within the cone of its arc.
void Flight::align(PartPlace part, const ConvexSet& set, const HeadingArc& had, double flown) {
  const HeadingArc& arc = parts_.arc(part);
  const Vec2 middle{part.ix + 0.5, part.iy + 0.5};
  // Every bit of the way leads on along the arc's middle, by the cosine of half its width.
  const double most = 1.5 / std::max(std::cos(0.5 * arc.width_rad), 1e-6);
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const Axis& axis = axes[k];
    if (!arc.meets({axis.heading_rad - 0.5 * pi, pi})) continue;
    double lo = -0.5;
    double hi = 0.5;
    const auto bound = [&](double heading_rad, double& end, bool lower) {
      const double across = std::remainder(heading_rad - axis.heading_rad, 2.0 * pi);
      if (std::abs(across) > 0.5 * pi) return;  // others of the arc lead anywhere up to this end
      double slope = std::tan(across);
      if (std::cos(across) <= least_outward) {
        if (lower != (across > 0.0)) return;
        slope = (lower ? 1.0 : -1.0) / least_outward;  // not as steep: it holds what is steeper
      }
      double found = lower ? HUGE_VAL : -HUGE_VAL;
      for (const Vec2 p : set.corners()) {
        const Vec2 from = p - middle;
        const double left = axis.outward.x * from.y - axis.outward.y * from.x;
        const double out = axis.outward.x * from.x + axis.outward.y * from.y;
        const double at = left + std::max(0.5 - out, 0.0) * slope;
        found = lower ? std::min(found, at) : std::max(found, at);
      }
      end = found;
    };
    bound(arc.lo_rad, lo, true);
    bound(arc.hi_rad(), hi, false);
    lo += 0.5 - 4.0 * place_slack;
    hi += 0.5 + 4.0 * place_slack;
    if (lo > 1.0 || hi < 0.0) continue;
    image_.crossings.push_back({part, static_cast<PartSide>(k), std::max(lo, 0.0),
                                std::min(hi, 1.0), had.with(arc), flown + most});
  }
}

/// Those of `starts` that are `wanted` turn.
void Flight::add_turning(const ConvexSet& set, HeadingArc starts, HeadingArc wanted, Turn side) {
  if (wanted.width_rad < 0.0) return;
  double base = starts.lo_rad - counted_from_zero(starts.lo_rad - wanted.lo_rad);
  for (int round = 0; round < 2; ++round, base += whole_turn_rad) {
    const double lo = std::max(starts.lo_rad, base);
    const double hi = std::min(starts.hi_rad(), base + wanted.width_rad);
    if (lo <= hi) turning_.push_back({set, lo, hi, side, {lo, hi - lo}, 0.0});
  }
}

void Flight::start(PartPlace part, const ConvexSet& set, double lo, double hi,
                   const HeadingArc* from) {
  switch (parts_.kind(part)) {
    case PartKind::obstacle:
      image_.ends |= 1U << static_cast<unsigned>(Verdict::collide);
      return;
    case PartKind::outside:
      image_.ends |= 1U << static_cast<unsigned>(Verdict::leave);
      return;
    case PartKind::goal:
      image_.ends |= 1U << static_cast<unsigned>(Verdict::reach);
      return;
    case PartKind::wild:
      image_.gave_up = true;
      return;
    case PartKind::ordinary:
      break;
  }
  const HeadingArc& arc = parts_.arc(part);
  const HeadingArc starts{lo, hi - lo};
  if (arc.widened(align_slack_rad).meets(starts)) align(part, set, starts, 0.0);
  // The smaller angle, and near opposite either side.
  const double half = pi + parts_.side_uncertain_rad() + heading_slack_rad;
  const double beside = half - start_slack_rad;
  add_turning(set, starts, {arc.lo_rad - half, beside}, Turn::left);
  add_turning(set, starts, {arc.hi_rad() + start_slack_rad, beside}, Turn::right);
  if (from == nullptr) return;
  // A side may be held already, where the part before had commands that far behind; it is kept when
  // this one's lie behind as well, on whichever side.
  const double hold = parts_.hold_side_rad() - heading_slack_rad;
  const double behind = from->width_rad - hold;
  if (behind < 0.0) return;
  const auto both = [&](HeadingArc held, HeadingArc wanted, Turn side) {
    double base = starts.lo_rad - counted_from_zero(starts.lo_rad - held.lo_rad);
    for (int round = 0; round < 2; ++round, base += whole_turn_rad) {
      const double l = std::max(starts.lo_rad, base);
      const double h = std::min(starts.hi_rad(), base + held.width_rad);
      if (l <= h) add_turning(set, {l, h - l}, wanted, side);
    }
  };
  both({from->lo_rad, behind}, {arc.lo_rad + hold, whole_turn_rad - hold}, Turn::left);
  both({from->lo_rad + hold, behind}, {arc.hi_rad(), whole_turn_rad - hold}, Turn::right);
}

Flight::Step Flight::step_from(const ConvexSet& set, double begin_rad, double size_rad,
                               Turn side) const {
  const double end_rad = begin_rad + static_cast<int>(side) * size_rad;
  // Tangents of the unit arc meet at this distance from its ends; the arc lies in their triangle.
  const double tangent = std::tan(0.5 * size_rad);
  const Vec2 first{tangent * std::cos(begin_rad), tangent * std::sin(begin_rad)};
  const Vec2 second{tangent * std::cos(end_rad), tangent * std::sin(end_rad)};
  const Vec2 chord = first + second;
  const double least = parts_.turn_radius().least;
  const double more = parts_.turn_radius().most - least;
  Step step{
      begin_rad, size_rad, {Vec2{}, more * first, more * chord, more * second}, least * chord, {}};
  const std::array<Vec2, 3> triangle{Vec2{}, least * first, least * chord};
  std::array<Vec2, 12> steps;
  std::size_t n = 0;
  for (const Vec2 a : triangle) {
    for (std::size_t k = 0; k < (more > 0.0 ? 4U : 1U); ++k) steps[n++] = a + step.spread[k];
  }
  step.swept = sum(set, {steps.data(), n});
  return step;
}

/// How far on the first arc begins or ends in a part that the step sweeps; its own size, if none.
double Flight::first_edge(const Step& step, Turn side) const {
  double least = step.size_rad;
  for_parts(step.swept, [&](PartPlace p, PartKind kind, const ConvexSet&) {
    if (kind != PartKind::ordinary) return;
    const HeadingArc& arc = parts_.arc(p);
    for (const double edge : {arc.lo_rad, arc.hi_rad()}) {
      const double on = counted_from_zero(static_cast<int>(side) * (edge - step.begin_rad));
      if (on > drop_slack_rad) least = std::min(least, on);
    }
  });
  return least;
}

void Flight::turn(const TurningSet& set) {
  const int sign = static_cast<int>(set.turn);
  const double hold = parts_.hold_side_rad();
  const double opposite = pi + parts_.side_uncertain_rad();
  double at = set.turn == Turn::left ? set.lo_rad : set.hi_rad;
  const double last = set.turn == Turn::left ? set.hi_rad : set.lo_rad;
  const auto still_to = [&](double heading) { return sign * (last - heading); };
  ConvexSet here = set.from;
  HeadingArc had = set.had;
  double flown = set.flown;
  bool forgot = false;  // some may hold no side any more
  while (true) {
    if (++steps_ > options_.most_steps || sign * (at - set.lo_rad) > 3.0 * whole_turn_rad) {
      image_.gave_up = true;
      return;
    }
    const bool more_start = still_to(at) > drop_slack_rad;
    double size = options_.step_rad;
    if (more_start) size = std::min(size, still_to(at));
    Step step = step_from(here, at, size, set.turn);
    if (const double edge = first_edge(step, set.turn); edge < size) {
      step = step_from(here, at, size = edge, set.turn);
    }
    const double end = at + sign * size;
    const HeadingArc these{std::min(at, end), size};
    had = had.with(these);
    flown += parts_.turn_radius().most * size;

    bool stop = false;
    bool now_forgot = false;
    for_parts(step.swept, [&](PartPlace p, PartKind kind, const ConvexSet& piece) {
      if (stop) return;
      if (kind != PartKind::ordinary) {
        start(p, piece, at, at, nullptr);  // it ends
        stop = image_.gave_up;
        return;
      }
      const HeadingArc& arc = parts_.arc(p);
      if (arc.widened(align_slack_rad).meets(these)) align(p, piece, had, flown);
      // No edge lies within the step: its middle is aligned as all of it.
      const double middle = beyond(arc, at + 0.5 * sign * size, set.turn);
      const double lo = middle - 0.5 * size - heading_slack_rad;
      const double hi = middle + 0.5 * size + heading_slack_rad;
      if (lo <= hold || hi >= whole_turn_rad - hold) now_forgot = true;
      if (middle <= arc.width_rad) return;
      const double reach = forgot || now_forgot ? opposite : hold;
      if (lo - arc.width_rad <= reach) {  // some command lies on the other side: it turns back
        turning_.push_back({piece, these.lo_rad, these.hi_rad(), other(set.turn), had, flown});
      }
    });
    if (stop) return;
    forgot = forgot || now_forgot;

    // Who turns on at the end of the step.
    std::array<Vec2, 4> chords = step.spread;
    for (Vec2& v : chords) v = v + step.chord;
    const std::size_t n = parts_.turn_radius().most > parts_.turn_radius().least ? 4 : 1;
    const ConvexSet there = more_start ? step.swept : sum(here, {chords.data(), n});
    std::vector<Vec2> on;
    for_parts(there, [&](PartPlace p, PartKind kind, const ConvexSet& piece) {
      if (kind != PartKind::ordinary) return;
      const HeadingArc& arc = parts_.arc(p);
      const double x = beyond(arc, end, set.turn);
      const bool aligned =
          x <= arc.width_rad + heading_slack_rad || x >= whole_turn_rad - heading_slack_rad;
      const bool ahead = !aligned && whole_turn_rad - x <= opposite + heading_slack_rad;
      const bool held = x >= hold - heading_slack_rad && x < whole_turn_rad - drop_slack_rad;
      if (ahead || held) on.insert(on.end(), piece.corners().begin(), piece.corners().end());
    });
    if (still_to(end) > drop_slack_rad) {
      on.insert(on.end(), set.from.corners().begin(), set.from.corners().end());
    }
    if (on.empty()) return;
    here = ConvexSet::hull(on);
    at = end;
  }
}

void Flight::touch(const ConvexSet& set) {
  for_parts(set, [&](PartPlace p, PartKind kind, const ConvexSet& piece) {
    if (kind == PartKind::obstacle || kind == PartKind::outside) start(p, piece, 0.0, 0.0, nullptr);
  });
}

void Flight::finish() {
  constexpr int most_sets = 100;
  for (int sets = 0; !turning_.empty() && !image_.gave_up; ++sets) {
    const TurningSet set = turning_.back();
    turning_.pop_back();
    if (sets > most_sets) image_.gave_up = true;
    turn(set);
  }
}

}  // namespace

BehaviourImage image_of_crossing(const Parts& parts, PartPlace part, PartSide side, double lo,
                                 double hi, const BehaviourOptions& options) {
  BehaviourImage image;
  Flight flight(parts, options, image);
  const Axis& axis = axes[static_cast<std::size_t>(side)];
  const Vec2 middle{part.ix + 0.5 + 0.5 * axis.outward.x, part.iy + 0.5 + 0.5 * axis.outward.y};
  const Vec2 left{-axis.outward.y, axis.outward.x};
  const ConvexSet set(middle + (lo - 0.5) * left, middle + (hi - 0.5) * left);
  const PartPlace next{part.ix + static_cast<int>(axis.outward.x),
                       part.iy + static_cast<int>(axis.outward.y)};
  flight.touch(set);
  // The headings of the arc that point outwards: one range of them, or two.
  const HeadingArc& arc = parts.arc(part);
  const double right = axis.heading_rad - 0.5 * pi;
  double base = right + counted_from_zero(arc.lo_rad - right);
  for (int round = 0; round < 2; ++round, base -= whole_turn_rad) {
    const double from = std::max(right, base);
    const double to = std::min(right + pi, base + arc.width_rad);
    if (from <= to) flight.start(next, set, from, to, &arc);
  }
  flight.finish();
  return image;
}

BehaviourImage image_of_state(const Parts& parts, Vec2 place, double heading_rad,
                              const BehaviourOptions& options) {
  BehaviourImage image;
  Flight flight(parts, options, image);
  const PartPlace part{static_cast<int>(std::floor(place.x)),
                       static_cast<int>(std::floor(place.y))};
  flight.touch(ConvexSet(place));
  flight.start(part, ConvexSet(place), heading_rad, heading_rad, nullptr);
  flight.finish();
  return image;
}

}  // namespace fairway
