// Single behaviours: a guess at what all of them come to.
#include <algorithm>

#include "fairway/inclusion/quick_flight.hpp"
#include "fairway/inclusion/quick_steps.hpp"

namespace fairway {

void QuickFlight::try_out(Vec2 place, TurnUnits heading, Vec2 unit) {
  const PartPlace part{static_cast<int>(place.x), static_cast<int>(place.y)};
  const PartRecord& record = table_.ringed(part);
  const TurnUnits beyond = heading - record.lo;
  if (beyond <= record.width) {
    leave({{part, &record, beyond}, Octagon::about(place, 0.0), 0.0, true});
    return;
  }
  if (may_turn(record.lo - heading)) try_turn(place, heading, unit, Turn::left);
  if (!is_undecided() && may_turn(beyond - record.width)) {
    try_turn(place, heading, unit, Turn::right);
  }
}

void QuickFlight::try_turn(Vec2 place, TurnUnits heading, Vec2 unit, Turn side) {
  constexpr TurnUnits step = 1U << 26U;
  constexpr int most_steps = 64;
  const double sign = side == Turn::left ? 1.0 : -1.0;
  for (const double radius : {options_.turn_radius.least, options_.turn_radius.most}) {
    const Vec2 middle = place + sign * radius * Vec2{-unit.y, unit.x};
    TurnUnits at = side == Turn::left ? heading / step * step : (heading + step - 1) / step * step;
    for (int k = 0;; ++k) {
      if (k == most_steps) {  // it never meets a command
        verdicts_ |= 1U << static_cast<unsigned>(Verdict::undecided);
        return;
      }
      at = side == Turn::left ? at + step : at - step;
      const Vec2 along = step_ends()[at >> finest_bits];
      const Vec2 there = middle + sign * radius * Vec2{along.y, -along.x};
      const PartPlace part{std::clamp(floor_of(there.x), -1, table_.nx()),
                           std::clamp(floor_of(there.y), -1, table_.ny())};
      const PartRecord& record = table_.ringed(part);
      if (ends_there(record.kind(), 0.0)) break;
      const TurnUnits beyond = at - record.lo;
      if (beyond > record.width) continue;
      leave({{part, &record, beyond}, Octagon::about(there, 0.0), 0.0, true});
      break;
    }
    if (is_undecided()) return;
  }
}

}  // namespace fairway
