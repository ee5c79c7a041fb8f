#include "fairway/inclusion/quick_flight.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "fairway/inclusion/part_pieces.hpp"
#include "fairway/inclusion/set_flight.hpp"

namespace fairway {
namespace {

constexpr unsigned bit(Verdict v) { return 1U << static_cast<unsigned>(v); }

struct Range {
  double lo;
  double hi;
};
Range above(Range r, double by) { return {r.lo + by, r.hi + by}; }
Range below(double from, Range r) { return {from - r.hi, from - r.lo}; }

/// A set as one sees it who looks out over a side: places along it, counted from the right, how
/// deep inside they lie, and the sum and the difference of the two.
struct Outlook {
  Range along;
  Range depth;
  Range sum;
  Range difference;

  Outlook(const Octagon& o, PartPlace part, std::size_t side) {
    const double px = part.ix;
    const double py = part.iy;
    const Range x = above({o.lo[0], o.hi[0]}, -px);
    const Range s = above({o.lo[1], o.hi[1]}, -px - py);
    const Range y = above({o.lo[2], o.hi[2]}, -py);
    const Range d = above({o.lo[3], o.hi[3]}, px - py);
    switch (static_cast<PartSide>(side)) {
      case PartSide::east:
        *this = Outlook(y, below(1.0, x), above(d, 1.0), above(s, -1.0));
        break;
      case PartSide::north:
        *this = Outlook(below(1.0, x), below(1.0, y), below(2.0, s), d);
        break;
      case PartSide::west:
        *this = Outlook(below(1.0, y), x, below(1.0, d), below(1.0, s));
        break;
      case PartSide::south:
        *this = Outlook(x, y, s, below(0.0, d));
        break;
    }
    depth.lo = std::max(depth.lo, 0.0);
  }

  /// Bounds of along + slope depth.
  double least(double slope) const {
    const double steep = std::abs(slope);
    const double end = slope > 0.0 ? sum.lo : difference.lo;
    if (steep <= 1.0) return (1.0 - steep) * along.lo + steep * end;
    return end + (steep - 1.0) * (slope > 0.0 ? depth.lo : -depth.hi);
  }
  double most(double slope) const {
    const double steep = std::abs(slope);
    const double end = slope > 0.0 ? sum.hi : difference.hi;
    if (steep <= 1.0) return (1.0 - steep) * along.hi + steep * end;
    return end + (steep - 1.0) * (slope > 0.0 ? depth.hi : -depth.lo);
  }

 private:
  Outlook(Range a, Range b, Range c, Range d) : along(a), depth(b), sum(c), difference(d) {}
};

/// The tangent of a heading against a side's outward one, a little less (`sign` -1) or more; none
/// when others of the arc lead anywhere.
bool slope_of(Vec2 unit, std::size_t side, double sign, double& slope) {
  constexpr double least_outward = 0x1p-12;
  const Vec2 outward = side_axes[side].outward;
  const double out = dot(outward, unit);
  const double left = cross(outward, unit);
  if (!(out > 0.0)) return false;
  if (out <= least_outward) {
    if ((sign < 0.0) != (left > 0.0)) return false;
    slope = -sign / least_outward;
    return true;
  }
  slope = left / out;
  constexpr double rounding = 4e-7;  // of floats, and of headings counted as aligned
  const double more = 1.0 + std::abs(slope);
  slope += sign * rounding * more * more;
  return true;
}

}  // namespace

bool QuickFlight::ends_there(PartKind kind, double flown) {
  if (kind == PartKind::ordinary) return false;
  verdicts_ |= kind == PartKind::obstacle  ? bit(Verdict::collide)
               : kind == PartKind::outside ? bit(Verdict::leave)
               : kind == PartKind::goal    ? bit(Verdict::reach)
                                           : bit(Verdict::undecided);
  worst_time_s_ = std::max(worst_time_s_, flown * options_.part_s);
  return true;
}

QuickFlightOptions QuickFlightOptions::of(const Parts& parts, double speed_least_mps, int steps) {
  // Far above what floats, angles in units and the slack of borders come to.
  constexpr double grown = 128.0 * place_slack;
  constexpr double longest_step = 4.0;  // in parts
  QuickFlightOptions made{parts.turn_radius(), grown, units_of_angle(parts.hold_side_rad()),
                          units_of_angle(pi + parts.side_uncertain_rad()),
                          parts.part_m() / speed_least_mps};
  made.finest_bin = static_cast<TurnUnits>(whole_turn_units / static_cast<unsigned>(steps));
  while (made.widest_bin > made.finest_bin &&
         made.turn_radius.most * made.widest_bin / turn_units_per_rad > longest_step) {
    made.widest_bin /= 2;
  }
  return made;
}

void QuickFlight::fly(Vec2 place, TurnUnits heading, Vec2 unit) {
  const PartPlace part{static_cast<int>(place.x), static_cast<int>(place.y)};  // none is negative
  const PartRecord& record = table_.ringed(part);
  if (ends_there(record.kind(), 0.0)) return;
  const Octagon here = Octagon::about(place, options_.grown);
  const std::uint64_t beyond = TurnUnits(heading - record.lo);
  if (beyond <= record.width + quick_slack || beyond + quick_slack >= whole_turn_units) {
    align({part, &record, beyond}, here, 0.0);
  }
  if (beyond < quick_slack || beyond + quick_slack > record.width) {
    const TurnUnits hi = record.lo + record.width;
    const auto may_turn = [&](Turn side, TurnUnits ahead) {
      if (ahead > options_.opposite + quick_slack && ahead + quick_slack < whole_turn_units) return;
      turning_[turning_count_++] = {here, part, side, heading, 0, unit, 0.0};
    };
    may_turn(Turn::right, heading - hi);
    may_turn(Turn::left, record.lo - heading);
  }
  turn_all();
}

void QuickFlight::fly(PartPlace part, const Octagon& set, TurnUnits from, TurnUnits span) {
  const PartRecord& record = table_.ringed(part);
  if (ends_there(record.kind(), 0.0)) return;
  from -= TurnUnits{quick_slack};
  span += TurnUnits{2 * quick_slack};
  const TurnUnits to = from + span;
  const TurnUnits hi = record.lo + record.width;
  const auto beyond = [](TurnUnits angle, TurnUnits base) {
    return static_cast<std::uint64_t>(static_cast<TurnUnits>(angle - base));
  };
  const bool holds_lo = beyond(record.lo, from) <= span;
  const bool holds_hi = beyond(hi, from) <= span;
  const bool begins_in_arc = beyond(from, record.lo) <= record.width;
  if (begins_in_arc || holds_lo) align({part, &record, 0}, set, 0.0);
  const std::uint64_t most = options_.opposite + quick_slack;
  const auto begin = [&](Turn side, TurnUnits first, TurnUnits over) {
    const double angle_rad = static_cast<double>(first) / turn_units_per_rad;
    turning_[turning_count_++] = {
        set, part, side, first, over, {std::cos(angle_rad), std::sin(angle_rad)}, 0.0};
  };
  // Above the arc, and below it; where the range holds neither end, it lies in the arc or outside.
  if (holds_hi) {
    begin(Turn::right, to, to - hi);
    if (beyond(record.lo, to) <= most) begin(Turn::left, hi, to - hi);
  }
  if (holds_lo) {
    begin(Turn::left, from, record.lo - from);
    if (beyond(from, hi) <= most) begin(Turn::right, record.lo, record.lo - from);
  }
  if (!holds_lo && !holds_hi && !begins_in_arc) {
    if (beyond(from, hi) <= most) begin(Turn::right, to, span);
    if (beyond(record.lo, to) <= most) begin(Turn::left, from, span);
  }
  turn_all();
}

void QuickFlight::turn_all() {
  while (turning_count_ > 0 && follows_all_ && !is_undecided()) {
    const Turning next = turning_[--turning_count_];
    turning_kept_ = turning_count_;
    turn(next);
  }
  leave_parts();
}

/// Tells what the step comes to on its way. False when that ends the flight.
bool QuickFlight::pass(const Step& step, const Octagon& swept) {
  for (std::size_t k = 0; k < met_count_; ++k) {
    const PartRecord& record = *met_[k].record;
    if (record.kind() != PartKind::ordinary) continue;
    forgot_ |= forgets(met_[k].beyond, step.size, record);
  }
  for (std::size_t k = 0; k < met_count_; ++k) {
    const PartRecord& record = *met_[k].record;
    if (ends_there(record.kind(), step.flown)) continue;
    const std::uint64_t from = met_[k].beyond;
    const std::uint64_t to = from + step.size;
    const bool begins_aligned = from <= record.width + quick_slack;
    if (begins_aligned || to + quick_slack >= whole_turn_units) align(met_[k], swept, step.flown);
    // Whether a command may lie on the other side.
    const std::uint64_t held = (forgot_ ? options_.opposite : options_.hold_side) + quick_slack;
    if (begins_aligned ? to > record.width + quick_slack : from - record.width <= held) {
      turn_back(step, swept, met_[k].part);
    }
  }
  return follows_all_ && !is_undecided();
}

/// Those of successive steps in one part turn back as one set, as in SetFlight::gather.
void QuickFlight::turn_back(const Step& step, const Octagon& set, PartPlace part) {
  constexpr double most_apart_rad = 0.3;
  constexpr auto most_apart = static_cast<std::uint64_t>(most_apart_rad * turn_units_per_rad);
  const Octagon piece = set.within(Octagon::square(part.ix, part.iy, options_.grown));
  if (!follows_all_ || piece.is_empty()) return;
  for (std::size_t k = turning_kept_; k < turning_count_; ++k) {
    Turning& one = turning_[k];
    const std::uint64_t gap =
        step.side == Turn::left ? TurnUnits(step.end - one.first) : TurnUnits(one.first - step.end);
    if (one.from.ix != part.ix || one.from.iy != part.iy || one.span + gap > most_apart) continue;
    one.set.hold(piece);
    one.first = step.end;
    one.span += gap;
    one.unit = step.end_unit;
    one.flown = step.flown;
    return;
  }
  if (turning_count_ == most_turning) {
    follows_all_ = false;
    return;
  }
  const Turn other = step.side == Turn::left ? Turn::right : Turn::left;
  turning_[turning_count_++] = {piece, part, other, step.end, step.size, step.end_unit, step.flown};
}

/// Of one part, successive steps tell of one set. What the first of them comes to may be enough.
void QuickFlight::align(const Met& met, const Octagon& set, double flown) {
  const Octagon piece = set.within(Octagon::square(met.part.ix, met.part.iy, options_.grown));
  if (piece.is_empty()) return;
  for (std::size_t k = 0; k < aligned_count_; ++k) {
    Aligned& one = aligned_[k];
    if (one.met.record != met.record) continue;
    one.set.hold(piece);
    one.flown = std::max(one.flown, flown);
    one.is_told = false;
    return;
  }
  if (aligned_count_ == most_aligned) leave_parts();
  aligned_[aligned_count_] = {met, piece, flown, true};
  leave(aligned_[aligned_count_++]);
}

/// Aligned behaviours stay so until they leave the part.
void QuickFlight::leave_parts() {
  for (std::size_t k = 0; k < aligned_count_ && !is_undecided(); ++k) {
    if (!aligned_[k].is_told) leave(aligned_[k]);
  }
  aligned_count_ = 0;
}

void QuickFlight::leave(const Aligned& aligned) {
  const PartRecord& record = *aligned.met.record;
  const Vec2 lowest{static_cast<double>(record.cos_lo), static_cast<double>(record.sin_lo)};
  const Vec2 highest{static_cast<double>(record.cos_hi), static_cast<double>(record.sin_hi)};
  for (std::size_t side = 0; side < sections_per_part; ++side) {
    if (!record.is_crossed(side)) continue;
    const Outlook seen(aligned.set, aligned.met.part, side);
    double lo = 0.0;
    double hi = 1.0;
    double slope = 0.0;
    constexpr double rounding = 0x1p-30;
    if (slope_of(lowest, side, -1.0, slope)) {
      lo = seen.least(slope) - rounding * (1.0 + std::abs(slope));
    }
    if (slope_of(highest, side, 1.0, slope)) {
      hi = seen.most(slope) + rounding * (1.0 + std::abs(slope));
    }
    if (lo > 1.0 || hi < 0.0) continue;
    const auto found = table_.find(aligned.met.part, side, std::max(lo, 0.0), std::min(hi, 1.0));
    verdicts_ |= found.verdicts;
    const double flown = aligned.flown + static_cast<double>(record.longest_way);
    worst_time_s_ = std::max(worst_time_s_, flown * options_.part_s + found.time_s);
  }
}

}  // namespace fairway
