#include "fairway/inclusion/quick_flight.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace fairway {
namespace {

/// Single states from which sets turn back more often are as good as never decided: of 200,000 on
/// four plans, one.
constexpr int most_turn_backs = 2;

constexpr unsigned bit(Verdict v) { return 1U << static_cast<unsigned>(v); }

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

bool QuickFlight::may_turn(TurnUnits ahead) const {
  return ahead <= options_.opposite + quick_slack || ahead + quick_slack >= whole_turn_units;
}

void QuickFlight::fly(Vec2 place, TurnUnits heading, Vec2 unit) {
  turn_backs_left_ = most_turn_backs;
  const PartPlace part{static_cast<int>(place.x), static_cast<int>(place.y)};  // none is negative
  const PartRecord& record = table_.ringed(part);
  if (ends_there(record.kind(), 0.0)) return;
  const Octagon here = Octagon::about(place, options_.grown);
  const std::uint64_t beyond = TurnUnits(heading - record.lo);
  if (beyond <= record.width + quick_slack || beyond + quick_slack >= whole_turn_units) {
    align({part, &record, beyond}, here, 0.0);
  }
  if (beyond < quick_slack || beyond + quick_slack > record.width) {
    const auto begin = [&](Turn side) {
      turning_[turning_count_++] = {here, part, side, heading, 0, unit, 0.0};
    };
    if (may_turn(heading - record.lo - record.width)) begin(Turn::right);
    if (may_turn(record.lo - heading)) begin(Turn::left);
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
  for (std::size_t k = 0; k < met_count_ && !forgot_; ++k) {
    const PartRecord& record = *met_[k].record;
    if (record.kind() == PartKind::ordinary) forgot_ = forgets(met_[k].beyond, step.size, record);
  }
  // Whether a command may lie on the other side.
  const std::uint64_t held = (forgot_ ? options_.opposite : options_.hold_side) + quick_slack;
  for (std::size_t k = 0; k < met_count_; ++k) {
    const PartRecord& record = *met_[k].record;
    if (ends_there(record.kind(), step.flown)) continue;
    const std::uint64_t from = met_[k].beyond;
    const std::uint64_t to = from + step.size;
    // Arcs have slack: where one ends or begins, nobody is aligned.
    const bool begins_aligned = from < record.width;
    if (begins_aligned || to > whole_turn_units) align(met_[k], swept, step.flown);
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
  if (turning_count_ == most_turning || turn_backs_left_-- == 0) {
    follows_all_ = false;
    return;
  }
  const Turn other = step.side == Turn::left ? Turn::right : Turn::left;
  turning_[turning_count_++] = {piece, part, other, step.end, step.size, step.end_unit, step.flown};
}

/// Of one part, successive steps tell of one set. What the first of them comes to may be enough.
void QuickFlight::align(const Met& met, const Octagon& set, double flown) {
  if (adds_nothing(met, flown)) return;
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

}  // namespace fairway
