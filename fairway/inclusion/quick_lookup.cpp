#include "fairway/inclusion/quick_lookup.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "fairway/inclusion/quick_flight.hpp"

namespace fairway {
namespace {

/// Places nearer to a part's border may be in the next part.
constexpr double border = 2.0 * place_slack;

constexpr int fine_steps = 256;
/// Steps of half a part.
int coarse_steps(double radius) {
  int steps = 32;
  while (steps < fine_steps && steps < 11.0 * radius) steps *= 2;
  return steps;
}

/// Whether the set touches none but ordinary parts.
bool is_clear_of_ends(const Parts& parts, const ConvexSet& set) {
  const auto [low, high] = set.box();
  const auto floor_of = [](double v) { return static_cast<int>(std::floor(v)); };
  for (int iy = floor_of(low.y - border); iy <= floor_of(high.y + border); ++iy) {
    for (int ix = floor_of(low.x - border); ix <= floor_of(high.x + border); ++ix) {
      if (parts.kind({ix, iy}) != PartKind::ordinary) return false;
    }
  }
  return true;
}

}  // namespace

QuickLookup::QuickLookup(const Parts& parts, const ContractVerdictsView& verdicts,
                         double speed_least_mps)
    : parts_(parts),
      verdicts_(verdicts),
      speed_least_mps_(speed_least_mps),
      table_(parts, verdicts),
      coarse_(
          QuickFlightOptions::of(parts, speed_least_mps, coarse_steps(parts.turn_radius().most))),
      fine_(QuickFlightOptions::of(parts, speed_least_mps, fine_steps)) {}

ContractAnswer QuickLookup::answer(Vec2 place, double heading_rad) const {
  const auto flown = [&] {
    return contract_answer(parts_, verdicts_, speed_least_mps_, place, heading_rad);
  };
  const bool inside =
      place.x > 0.0 && place.y > 0.0 && place.x < parts_.nx() && place.y < parts_.ny();
  const bool fits = parts_.turn_radius().most <= QuickFlightOptions::most_radius;
  if (!inside || !fits || !std::isfinite(heading_rad)) return flown();
  const Vec2 in{place.x - static_cast<int>(place.x), place.y - static_cast<int>(place.y)};
  if (std::min(in.x, in.y) < border || std::max(in.x, in.y) > 1.0 - border) return flown();

  const double in_turn_rad = counted_from_zero(heading_rad);
  const TurnUnits heading = units_of_angle(in_turn_rad);
  const Vec2 unit{std::cos(in_turn_rad), std::sin(in_turn_rad)};
  ContractAnswer answer;
  answer.worst_time_s = std::numeric_limits<double>::infinity();
  for (const QuickFlightOptions* options : {&coarse_, &fine_}) {
    QuickFlight flight(table_, *options);
    flight.fly(place, heading, unit);
    answer.possible = static_cast<std::uint8_t>(flight.verdicts());
    if (flight.follows_all() && std::has_single_bit(flight.verdicts()) && !flight.is_undecided()) {
      answer.verdict = static_cast<Verdict>(std::countr_zero(flight.verdicts()));
      answer.worst_time_s = flight.worst_time_s();
      return answer;
    }
    if (options == &fine_) {
      if (flight.was_too_wide()) return flown();
      break;
    }
    QuickFlight single(table_, fine_);
    single.try_out(place, heading, unit);
    if (single.is_undecided()) {
      answer.possible |= static_cast<std::uint8_t>(single.verdicts());
      break;
    }
  }
  return answer;
}

QuickLookup::SetReach QuickLookup::reach(PartPlace part, const ConvexSet& set,
                                         const HeadingArc& headings) const {
  if (!(parts_.turn_radius().most <= QuickFlightOptions::most_radius) ||
      headings.width_rad > 0.5 * pi || !is_clear_of_ends(parts_, set)) {
    return {};
  }
  Octagon octagon = Octagon::empty();
  for (const Vec2 corner : set.corners()) octagon.hold(Octagon::about(corner, coarse_.grown));
  const TurnUnits from = units_of_angle(counted_from_zero(headings.lo_rad));
  const TurnUnits span = units_of_angle(headings.width_rad) + 2;
  for (const QuickFlightOptions* options : {&coarse_, &fine_}) {
    QuickFlight flight(table_, *options);
    flight.fly(part, octagon, from, span);
    if (flight.was_too_wide() && options == &fine_) return {};
    const bool reaches = flight.follows_all() && !flight.is_undecided() &&
                         flight.verdicts() == 1U << static_cast<unsigned>(Verdict::reach);
    if (reaches && options == &coarse_) return {Reaches::yes, flight.worst_time_s()};
    if (reaches) return {};
  }
  return {Reaches::no, 0.0};
}

ContractAnswer QuickLookup::answer(const Grid& grid, Vec2 position_m, double heading_rad) const {
  const Vec2 place = (1.0 / parts_.part_m()) * (position_m - Vec2{grid.x0_m, grid.y0_m});
  const bool inside =
      place.x >= 0.0 && place.y >= 0.0 && place.x < parts_.nx() && place.y < parts_.ny();
  if (inside) return answer(place, heading_rad);
  return contract_answer(grid, parts_, verdicts_, speed_least_mps_, position_m, heading_rad);
}

}  // namespace fairway
