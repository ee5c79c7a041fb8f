#include "fairway/inclusion/set_flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "fairway/inclusion/part_pieces.hpp"
#include "fairway/inclusion/tube.hpp"

namespace fairway {
namespace {

/// The cosine to a side's outward heading below which slopes are not computed.
constexpr double least_outward = 0x1p-12;

/// The headings of `arc` that lie in `range`, at most two runs: calls body(lo, hi).
template <typename Body>
void for_common(const HeadingArc& arc, double range_lo, double range_hi, const Body& body) {
  if (arc.width_rad >= whole_turn_rad) return body(range_lo, range_hi);
  double base = range_lo + counted_from_zero(arc.lo_rad - range_lo);
  for (int round = 0; round < 2; ++round, base -= whole_turn_rad) {
    const double lo = std::max(range_lo, base);
    const double hi = std::min(range_hi, base + arc.width_rad);
    if (lo <= hi) body(lo, hi);
  }
}

/// Whether headings are not the same, but nearly so.
bool hardly_differ(double a_rad, double b_rad) {
  const double off = std::abs(std::remainder(a_rad - b_rad, whole_turn_rad));
  return off > 1e-12 && off < 1e-5;
}

}  // namespace

ConvexSet segment_of_side(PartPlace part, PartSide side, double lo, double hi) {
  const SideAxis& axis = side_axes[static_cast<std::size_t>(side)];
  const Vec2 middle{part.ix + 0.5 + 0.5 * axis.outward.x, part.iy + 0.5 + 0.5 * axis.outward.y};
  const Vec2 left{-axis.outward.y, axis.outward.x};
  return {middle + (lo - 0.5) * left, middle + (hi - 0.5) * left};
}

PartPlace part_beyond(PartPlace part, PartSide side) {
  const SideAxis& axis = side_axes[static_cast<std::size_t>(side)];
  return {part.ix + static_cast<int>(axis.outward.x), part.iy + static_cast<int>(axis.outward.y)};
}

/// Behaviours that move along headings of `arc` (narrower than pi) from `set` until they leave the
/// part: calls body(side, lo, hi) with the places where they may. From a place on the side itself,
/// exactly given, the way there is none, and the range ends exactly at it: flights along a border
/// that cross it to and fro do not leak past the ends of leaves.
template <typename Body>
void SetFlight::exits(PartPlace part, const ConvexSet& set, const HeadingArc& arc, double slack,
                      const Body& body) const {
  constexpr double rounding = 0x1p-30;  // far above that of a tangent and a product
  const Vec2 middle{part.ix + 0.5, part.iy + 0.5};
  for (std::size_t k = 0; k < side_axes.size(); ++k) {
    const SideAxis& axis = side_axes[k];
    if (!is_crossed(arc, static_cast<PartSide>(k))) continue;
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
        const double along = std::max(0.5 - out, 0.0) * slope;
        const double at = left + along;
        const double off = rounding * std::abs(along) + slack;
        found = lower ? std::min(found, at - off) : std::max(found, at + off);
      }
      end = found;
    };
    bound(arc.lo_rad, lo, true);
    bound(arc.hi_rad(), hi, false);
    lo += 0.5;
    hi += 0.5;
    if (lo > 1.0 || hi < 0.0) continue;
    body(static_cast<PartSide>(k), std::max(lo, 0.0), std::min(hi, 1.0));
  }
}

/// Flights to and fro along a border would leak past the end of a leaf otherwise, by the slack of
/// every turn.
void SetFlight::keep_ahead_of_start(Crossing& crossing) const {
  if (!start_) return;
  const double along_rad =
      side_axes[static_cast<std::size_t>(crossing.side)].heading_rad + 0.5 * pi;
  const auto only_towards = [&](double heading_rad) {
    const double right = heading_rad - 0.5 * pi + heading_slack_rad;
    return counted_from_zero(crossing.headings.lo_rad - right) + crossing.headings.width_rad <=
           pi - 2.0 * heading_slack_rad;
  };
  const bool is_level = crossing.side == PartSide::north || crossing.side == PartSide::south;
  const int corner = is_level ? crossing.part.ix : crossing.part.iy;
  const double from = (is_level ? start_->lowest.x : start_->lowest.y) - corner;
  const double to = (is_level ? start_->highest.x : start_->highest.y) - corner;
  const bool counts_up = crossing.side == PartSide::east || crossing.side == PartSide::south;
  const double first = counts_up ? from : 1.0 - to;
  const double last = counts_up ? to : 1.0 - from;
  if (only_towards(along_rad)) crossing.lo = std::min(std::max(crossing.lo, first), crossing.hi);
  if (only_towards(along_rad + pi)) {
    crossing.hi = std::max(std::min(crossing.hi, last), crossing.lo);
  }
}

/// Aligned behaviours stay so until they leave the part.
void SetFlight::align(PartPlace part, const ConvexSet& set, const Past& past, double slack) {
  const HeadingArc& arc = parts_.arc(part);
  note(part, arc);
  const double most = longest_way(arc);
  exits(part, set, arc, slack, [&](PartSide side, double lo, double hi) {
    image_.crossings.push_back({part, side, lo, hi, past.headings.with(arc), past.flown + most});
    keep_ahead_of_start(image_.crossings.back());
  });
}

/// Those of `arriving` with `wanted` headings turn.
void SetFlight::add_turning(const ArrivingSet& arriving, HeadingArc wanted, Turn side) {
  if (wanted.width_rad < 0.0) return;
  for_common(wanted, arriving.lo_rad, arriving.hi_rad, [&](double lo, double hi) {
    Past past = arriving.past;
    past.headings = past.headings.with({lo, hi - lo});
    turning_.push_back({{arriving.set, lo, hi, past}, side});
  });
}

void SetFlight::note(PartPlace part, const HeadingArc& headings) {
  const std::size_t at = options_.tube != nullptr || options_.tells_visits ? parts_.index(part) : 0;
  if (options_.tells_visits) image_.visits.push_back({at, headings});
  if (options_.tube == nullptr) return;
  image_.distance_m = std::max(image_.distance_m, options_.tube->distance_m(at));
  if (image_.distance_m == Tube::outside) return;
  image_.off_rad = std::max(image_.off_rad, options_.tube->off_rad(at, headings));
}

/// Ends where nothing flies on.
bool SetFlight::ends_there(PartKind kind) {
  const auto end = [&](Verdict v) { image_.ends |= 1U << static_cast<unsigned>(v); };
  if (kind == PartKind::obstacle) end(Verdict::collide);
  if (kind == PartKind::outside) end(Verdict::leave);
  if (kind == PartKind::goal) end(Verdict::reach);
  if (kind == PartKind::closed) image_.gave_up = true;
  return !is_flown_over(kind);
}

void SetFlight::start(PartPlace part, const ArrivingSet& arriving, const HeadingArc* from) {
  const PartKind kind = parts_.kind(part);
  if (ends_there(kind)) {
    image_.flown = std::max(image_.flown, arriving.past.flown);
    return;
  }
  if (kind == PartKind::wild) {
    image_.gave_up = true;
    return;
  }
  const HeadingArc& arc = parts_.arc(part);
  const HeadingArc starts{arriving.lo_rad, arriving.hi_rad - arriving.lo_rad};
  note(part, starts);
  if (arc.widened(align_slack_rad).meets(starts)) {
    // Who checks may take a heading that is hardly beside an arc past it, and back.
    const bool is_beside =
        hardly_differ(arriving.lo_rad, arc.lo_rad) || hardly_differ(arriving.hi_rad, arc.hi_rad());
    const double more = is_beside ? parts_.turn_radius().most * options_.step_rad : 0.0;
    align(part, arriving.set, {arriving.past.headings.with(starts), arriving.past.flown + more},
          arriving.slack);
  }
  // The smaller angle, and near opposite either side.
  const double half = pi + parts_.side_uncertain_rad() + heading_slack_rad;
  const double beside = half - start_slack_rad;
  add_turning(arriving, {arc.lo_rad - half, beside}, Turn::left);
  add_turning(arriving, {arc.hi_rad() + start_slack_rad, beside}, Turn::right);
  if (from == nullptr) return;
  // A side may be held already, where the part before had commands that far behind; it is kept when
  // this one's lie behind as well, on whichever side.
  const double hold = parts_.hold_side_rad() - heading_slack_rad;
  const double behind = from->width_rad - hold;
  if (behind < 0.0) return;
  const auto both = [&](HeadingArc held, HeadingArc wanted, Turn side) {
    for_common(held, arriving.lo_rad, arriving.hi_rad, [&](double lo, double hi) {
      add_turning({arriving.set, lo, hi, arriving.past}, wanted, side);
    });
  };
  both({from->lo_rad, behind}, {arc.lo_rad + hold, whole_turn_rad - hold}, Turn::left);
  both({from->lo_rad + hold, behind}, {arc.hi_rad(), whole_turn_rad - hold}, Turn::right);
}

void SetFlight::touch(const ConvexSet& set) {
  for_parts(parts_, set, [&](PartPlace, PartKind kind, const ConvexSet&) { ends_there(kind); });
}

/// Whether nothing more needs to be flown.
bool SetFlight::is_over() {
  if (options_.is_enough != nullptr && !image_.is_partial && !image_.gave_up) {
    image_.is_partial = (*options_.is_enough)(image_);
  }
  return image_.gave_up || image_.is_partial;
}

void SetFlight::finish() {
  const int most_sets = options_.most_steps;
  for (int sets = 0; !turning_.empty() && !is_over(); ++sets) {
    const TurningSet set = turning_.back();
    turning_.pop_back();
    if (sets > most_sets) image_.gave_up = true;
    turn(set);
  }
}

BehaviourImage image_of_crossing(const Parts& parts, PartPlace part, PartSide side, double lo,
                                 double hi, const BehaviourOptions& options) {
  BehaviourImage image;
  SetFlight flight(parts, options, image);
  const ConvexSet set = segment_of_side(part, side, lo, hi);
  flight.touch(set);
  flight.starts_within(set.box());
  // The headings of the arc that point outwards: one range of them, or two.
  const HeadingArc& arc = parts.arc(part);
  const double right = side_axes[static_cast<std::size_t>(side)].heading_rad - 0.5 * pi;
  for_common(arc, right, right + pi, [&](double from, double to) {
    flight.note(part, {from, to - from});
    flight.start(part_beyond(part, side), {set, from, to, {{from, to - from}, 0.0}}, &arc);
  });
  flight.finish();
  return image;
}

BehaviourImage image_of_state(const Parts& parts, Vec2 place, double heading_rad,
                              const BehaviourOptions& options) {
  BehaviourImage image;
  SetFlight flight(parts, options, image);
  const ConvexSet set(place);
  flight.touch(set);
  const ArrivingSet arriving{
      set, heading_rad, heading_rad, {{heading_rad, 0.0}, 0.0}, 16.0 * place_slack};
  // In parts the place is rounded: so near a border it may be in either.
  const auto below = [](double v) { return static_cast<int>(std::floor(v - place_slack)); };
  const auto above = [](double v) { return static_cast<int>(std::floor(v + place_slack)); };
  for (int iy = below(place.y); iy <= above(place.y); ++iy) {
    for (int ix = below(place.x); ix <= above(place.x); ++ix) {
      flight.start({ix, iy}, arriving, nullptr);
    }
  }
  flight.finish();
  return image;
}

BehaviourImage image_of_states(const Parts& parts, PartPlace part, const ConvexSet& set,
                               const HeadingArc& headings, const BehaviourOptions& options) {
  BehaviourImage image;
  SetFlight flight(parts, options, image);
  flight.touch(set);
  const ArrivingSet arriving{
      set, headings.lo_rad, headings.hi_rad(), {headings, 0.0}, 16.0 * place_slack};
  flight.start(part, arriving, nullptr);
  flight.finish();
  return image;
}

}  // namespace fairway
