// The turn of a set, in long steps where nothing happens.
#include <algorithm>

#include "fairway/inclusion/quick_flight.hpp"
#include "fairway/inclusion/quick_steps.hpp"

namespace fairway {
/// Calls body(part, record) for the parts that the set lies over, for as long as it says true.
template <typename Body>
bool QuickFlight::for_met(const Octagon& swept, const Body& body) const {
  const int x0 = std::max(floor_of(swept.lo[0]), -1);
  const int x1 = std::min(floor_of(swept.hi[0]), table_.nx());
  const int y0 = std::max(floor_of(swept.lo[2]), -1);
  const int y1 = std::min(floor_of(swept.hi[2]), table_.ny());
  const int sum_lo = ceiling_of(swept.lo[1]) - 2;
  const int sum_hi = floor_of(swept.hi[1]);
  const int difference_lo = ceiling_of(swept.lo[3]) - 1;
  const int difference_hi = floor_of(swept.hi[3]) + 1;
  for (int iy = y0; iy <= y1; ++iy) {
    const PartRecord* row = &table_.ringed({x0, iy});
    const int from = std::max(x0, std::max(sum_lo - iy, iy - difference_hi));
    const int to = std::min(x1, std::min(sum_hi - iy, iy - difference_lo));
    for (int ix = from; ix <= to; ++ix) {
      if (!body(PartPlace{ix, iy}, row[ix - x0])) return false;
    }
  }
  return true;
}

/// Notes which parts the set lies over. False when they are too many.
bool QuickFlight::meet(const Octagon& swept, const Step& step) {
  met_count_ = 0;
  was_too_wide_ |= !for_met(swept, [&](PartPlace part, const PartRecord& record) {
    if (met_count_ == most_met) return false;
    met_[met_count_++] = {part, &record, step.beyond(record)};
    return true;
  });
  follows_all_ &= !was_too_wide_;
  return follows_all_;
}

/// Keeps those that this set lies over, too: it holds no more than that of meet.
void QuickFlight::keep_met(const Octagon& swept) {
  const auto is_over = [&](const PartPlace& p) {
    const double x = p.ix;
    const double y = p.iy;
    return (swept.lo[0] < x + 1.0) & (swept.hi[0] >= x) & (swept.lo[2] < y + 1.0) &
           (swept.hi[2] >= y) & (swept.lo[1] <= x + y + 2.0) & (swept.hi[1] >= x + y) &
           (swept.lo[3] <= y - x + 1.0) & (swept.hi[3] >= y - x - 1.0);
  };
  std::size_t kept = 0;
  for (std::size_t k = 0; k < met_count_; ++k) {
    met_[kept] = met_[k];
    kept += is_over(met_[k].part) ? 1 : 0;
  }
  met_count_ = kept;
}

/// Whether commands may come so near that a side is held no more.
bool QuickFlight::forgets(std::uint64_t beyond, TurnUnits size, const PartRecord& record) const {
  return beyond <= record.width + quick_slack + options_.hold_side ||
         beyond + size + quick_slack + options_.hold_side >= whole_turn_units;
}

/// How far on behaviours do nothing but turn on, in all parts that the step leads through: exactly
/// to where the first arc begins, at most. Arcs have slack, so nobody is aligned there yet.
QuickFlight::ClearWay QuickFlight::clear_way(const Octagon& swept, const Step& step) const {
  std::uint64_t farthest = 0;           // beyond the beginning of an arc
  std::int64_t gap = whole_turn_units;  // since one ended
  const PartRecord* first = nullptr;
  unsigned kinds = 0;
  for_met(swept, [&](PartPlace, const PartRecord& record) {
    const std::uint64_t from = step.beyond(record);
    first = from >= farthest ? &record : first;
    farthest = std::max(from, farthest);
    gap = std::min(gap, static_cast<std::int64_t>(from) - std::int64_t{record.width});
    kinds |= static_cast<unsigned>(record.kind());
    return true;
  });
  static_assert(static_cast<unsigned>(PartKind::ordinary) == 0);
  if (kinds != 0) return {};
  const std::uint64_t room = whole_turn_units - farthest;
  // Whether they hold a side does not matter where no command is opposite.
  if (gap > std::int64_t{options_.opposite} + std::int64_t{quick_slack}) {
    return {room, first, step.size + options_.hold_side + quick_slack >= room};
  }
  const std::uint64_t hold = options_.hold_side + quick_slack;
  if (forgot_ || gap <= static_cast<std::int64_t>(hold) || room <= hold) return {};
  return {room - hold - 1, nullptr, false};
}

/// Of who is in a part at the end of a step.
bool QuickFlight::turns_on(TurnUnits size, const Met& met) const {
  const PartRecord& record = *met.record;
  if (record.kind() != PartKind::ordinary) return false;
  const std::uint64_t at = TurnUnits(met.beyond + size);
  if (at >= quick_slack && at + quick_slack <= record.width) return false;  // all are aligned
  const bool ahead = at < quick_slack || whole_turn_units - at <= options_.opposite + quick_slack;
  return ahead || at + quick_slack >= options_.hold_side;
}

QuickFlight::Sweep QuickFlight::sweep(const Octagon& here, Vec2 from, const Step& step) const {
  const auto [least, most] = options_.turn_radius;
  const Vec2 to = step.end_unit;
  const Vec2 chord = step.side == Turn::left ? Vec2{to.y - from.y, from.x - to.x}
                                             : Vec2{from.y - to.y, to.x - from.x};
  const auto on = Octagon::measures(chord);
  Sweep made;
  for (std::size_t k = 0; k < Octagon::directions; ++k) {
    const double least_on = least * on[k];
    const double most_on = most * on[k];
    made.swept.lo[k] = here.lo[k] + std::min(most_on, 0.0);
    made.swept.hi[k] = here.hi[k] + std::max(most_on, 0.0);
    made.ends.lo[k] = here.lo[k] + std::min(least_on, most_on);
    made.ends.hi[k] = here.hi[k] + std::max(least_on, most_on);
  }
  return made;
}

/// The step to the next multiple of `bin`.
QuickFlight::Step QuickFlight::step_to(Turn side, TurnUnits at, TurnUnits bin) {
  const bool to_left = side == Turn::left;
  const TurnUnits size = to_left ? bin - at % bin : (at - 1) % bin + 1;
  const TurnUnits end = to_left ? at + size : at - size;
  return {at, size, end, side, step_ends()[end >> finest_bits], 0.0};
}

/// It ends at once where an arc begins or ends. Whether it does.
bool QuickFlight::end_at_edges(Step& step) const {
  // Those at most the slack ahead wrap to the far end.
  constexpr auto nearest = static_cast<TurnUnits>(quick_slack) + 1;
  if (step.size <= nearest) return false;
  TurnUnits least = step.size - nearest;
  const PartRecord* first = nullptr;
  bool is_end = false;  // of an arc
  for (std::size_t k = 0; k < met_count_; ++k) {
    const auto beyond = static_cast<TurnUnits>(met_[k].beyond);
    const TurnUnits begin = 0U - beyond - nearest;
    const TurnUnits end = met_[k].record->width - beyond - nearest;
    const TurnUnits on = std::min(begin, end);
    is_end = on < least ? end < begin : is_end;
    first = on < least ? met_[k].record : first;
    least = std::min(on, least);
  }
  if (first == nullptr) return false;
  const bool to_left = step.side == Turn::left;
  step.size = least + nearest;
  step.end = to_left ? step.at + step.size : step.at - step.size;
  step.end_unit = to_left == is_end ? first->highest() : first->lowest();
  return true;
}

/// Ends a step where the way is clear no farther; false where that is not worth a step.
bool QuickFlight::end_at(const ClearWay& way, Step& step) {
  constexpr TurnUnits least = 1U << 22U;
  if (way.size >= step.size) return true;
  if (way.size < least) return false;
  const bool to_left = step.side == Turn::left;
  const auto size = static_cast<TurnUnits>(way.size);
  if (way.first != nullptr) {
    step.size = size;
    step.end_unit = to_left ? way.first->lowest() : way.first->highest();
  } else {
    const TurnUnits over =
        (to_left ? step.at + size : 0U - (step.at - size)) & ((1U << finest_bits) - 1U);
    if (over + least > size) return false;
    step.size = size - over;
    const TurnUnits end = to_left ? step.at + step.size : step.at - step.size;
    step.end_unit = step_ends()[end >> finest_bits];
  }
  step.end = to_left ? step.at + step.size : step.at - step.size;
  return true;
}

/// Turns on, as far as nothing else happens. `bin`: what the step ends at a multiple of, at most.
/// Gives that of the next step.
TurnUnits QuickFlight::leap(TurnUnits bin, Front& front, Turn side) {
  Step step = step_to(side, front.at, bin);
  Sweep by = sweep(front.set, front.unit, step);
  const TurnUnits size = step.size;
  const ClearWay way = clear_way(by.swept, step);
  if (!end_at(way, step)) return options_.finest_bin;
  if (step.size < size) by = sweep(front.set, front.unit, step);
  forgot_ |= way.forgets;
  front = {by.ends, step.end, step.end_unit, front.turned + step.size};
  return step.size < size ? options_.finest_bin : options_.widest_bin;
}

void QuickFlight::turn(const Turning& start) {
  Front front{start.set, start.first, start.unit, 0};
  TurnUnits bin = options_.widest_bin;
  const PartRecord& first = table_.ringed(start.from);
  bool is_clear = false;
  const Step none{front.at, 0, front.at, start.side, {}, 0.0};
  forgot_ = forgets(none.beyond(first), 0, first);
  while (true) {
    const bool more_start = start.span > front.turned + quick_slack;
    follows_all_ &= ++tries_ <= most_tries;
    if (!follows_all_) return;
    // Far, while they turn on in all parts on the way.
    if (more_start) bin = options_.finest_bin;
    if (bin > options_.finest_bin) {
      bin = leap(bin, front, start.side);
      continue;
    }
    Step step = step_to(start.side, front.at, bin);
    Sweep by = sweep(front.set, front.unit, step);
    if (!meet(by.swept, step)) return;
    if (end_at_edges(step)) {
      by = sweep(front.set, front.unit, step);
      keep_met(by.swept);
    }
    front.turned += step.size;
    step.flown = start.flown + options_.turn_radius.most / turn_units_per_rad *
                                   static_cast<double>(front.turned + whole_turn_units / 32);
    if (!pass(step, by.swept)) return;
    // Some begin to turn at every heading of the step.
    const Octagon& there = more_start ? by.swept : by.ends;

    std::size_t on = 0;
    for (std::size_t k = 0; k < met_count_; ++k) {
      if (turns_on(step.size, met_[k])) met_[on++] = met_[k];
    }
    if (on == met_count_) {
      front.set = there;
      // The first part ahead may just not be met yet: far again only after two such steps.
      if (is_clear) bin = options_.widest_bin;
      is_clear = !is_clear;
    } else {
      Octagon here = Octagon::empty();
      for (std::size_t k = 0; k < on; ++k) {
        const PartPlace p = met_[k].part;
        const Octagon piece = there.within(Octagon::square(p.ix, p.iy, options_.grown));
        if (!piece.is_empty()) here.hold(piece);
      }
      if (start.span > front.turned + quick_slack) here.hold(start.set);
      if (here.is_empty()) return;
      front.set = here;
      is_clear = false;
    }
    front.at = step.end;
    front.unit = step.end_unit;
  }
}

}  // namespace fairway
