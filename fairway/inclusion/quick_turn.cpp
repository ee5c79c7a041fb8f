// The turn of a set, in long steps where nothing happens.
#include <algorithm>
#include <array>
#include <cmath>

#include "fairway/inclusion/quick_flight.hpp"

namespace fairway {
namespace {

// Steps end at multiples of an eighth of a turn, at least, so that within one no direction of the
// octagon changes its sign.
constexpr unsigned finest_bits = 24;
constexpr std::size_t finest_steps = 256;

const std::array<Vec2, finest_steps>& step_ends() {
  static const std::array<Vec2, finest_steps> made = [] {
    std::array<Vec2, finest_steps> all;
    for (std::size_t k = 0; k < finest_steps; ++k) {
      const double angle = whole_turn_rad / finest_steps * static_cast<double>(k);
      all[k] = {std::cos(angle), std::sin(angle)};
    }
    return all;
  }();
  return made;
}

int floor_of(double v) {
  const int whole = static_cast<int>(v);
  return whole - (static_cast<double>(whole) > v ? 1 : 0);
}

int ceiling_of(double v) {
  const int whole = static_cast<int>(v);
  return whole + (static_cast<double>(whole) < v ? 1 : 0);
}

}  // namespace

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

/// Whether commands may come so near that a side is held no more.
bool QuickFlight::forgets(std::uint64_t beyond, TurnUnits size, const PartRecord& record) const {
  return beyond <= record.width + quick_slack + options_.hold_side ||
         beyond + size + quick_slack + options_.hold_side >= whole_turn_units;
}

/// Whether behaviours do nothing but turn on, in all parts on the way.
bool QuickFlight::is_clear(const Octagon& swept, const Step& step) const {
  const std::uint64_t behind = (forgot_ ? options_.opposite : options_.hold_side) + quick_slack;
  const std::uint64_t ahead = (forgot_ ? 0 : options_.hold_side) + quick_slack;
  return for_met(swept, [&](PartPlace, const PartRecord& record) {
    const std::uint64_t from = step.beyond(record);
    return record.kind() == PartKind::ordinary && from > record.width + behind &&
           from + step.size + ahead < whole_turn_units;
  });
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

/// It ends at once where an arc begins or ends.
void QuickFlight::end_at_edges(Step& step) const {
  const bool to_left = step.side == Turn::left;
  for (std::size_t k = 0; k < met_count_; ++k) {
    const PartRecord& record = *met_[k].record;
    if (record.kind() != PartKind::ordinary) continue;
    const auto cut = [&](TurnUnits edge, float cosine, float sine) {
      const TurnUnits on = to_left ? edge - step.at : step.at - edge;
      if (on <= quick_slack || on >= step.size) return;
      step.size = on;
      step.end = edge;
      step.end_unit = {static_cast<double>(cosine), static_cast<double>(sine)};
    };
    cut(record.lo, record.cos_lo, record.sin_lo);
    cut(record.lo + record.width, record.cos_hi, record.sin_hi);
  }
}

void QuickFlight::turn(const Turning& start) {
  Octagon here = start.set;
  TurnUnits at = start.first;
  Vec2 from = start.unit;
  std::uint64_t turned = 0;
  TurnUnits bin = options_.widest_bin;
  const PartRecord& first = table_.ringed(start.from);
  const Step none{at, 0, at, start.side, {}, 0.0};
  forgot_ = forgets(none.beyond(first), 0, first);
  while (true) {
    const bool more_start = start.span > turned + quick_slack;
    follows_all_ &= ++tries_ <= most_tries;
    if (!follows_all_) return;
    // Far, while they turn on in all parts on the way.
    if (more_start) bin = options_.finest_bin;
    Step step = step_to(start.side, at, bin);
    Sweep by = sweep(here, from, step);
    if (bin > options_.finest_bin) {
      if (!is_clear(by.swept, step)) {
        bin /= 2;
        continue;
      }
      here = by.ends;
      turned += step.size;
      at = step.end;
      from = step.end_unit;
      bin = std::min(4 * bin, options_.widest_bin);
      continue;
    }
    if (!meet(by.swept, step)) return;
    const TurnUnits size = step.size;
    end_at_edges(step);
    if (step.size < size) {
      by = sweep(here, from, step);
      if (!meet(by.swept, step)) return;
    }
    turned += step.size;
    step.flown = start.flown + options_.turn_radius.most / turn_units_per_rad *
                                   static_cast<double>(turned + whole_turn_units / 32);
    if (!pass(step, by.swept)) return;
    // Some begin to turn at every heading of the step.
    const Octagon& there = more_start ? by.swept : by.ends;

    std::size_t on = 0;
    for (std::size_t k = 0; k < met_count_; ++k) {
      if (turns_on(step.size, met_[k])) met_[on++] = met_[k];
    }
    if (on == met_count_) {
      here = there;
      bin = std::min(4 * bin, options_.widest_bin);
    } else {
      here = Octagon::empty();
      for (std::size_t k = 0; k < on; ++k) {
        const PartPlace p = met_[k].part;
        const Octagon piece = there.within(Octagon::square(p.ix, p.iy, options_.grown));
        if (!piece.is_empty()) here.hold(piece);
      }
      if (start.span > turned + quick_slack) here.hold(start.set);
      if (here.is_empty()) return;
    }
    at = step.end;
    from = step.end_unit;
  }
}

}  // namespace fairway
