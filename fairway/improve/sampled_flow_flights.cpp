#include <algorithm>
#include <array>
#include <cmath>

#include "fairway/base/random.hpp"
#include "fairway/improve/sampled_flow.hpp"

namespace fairway {

namespace {

/// The part of a direction that leads out of a side.
double outward(Vec2 u, Side side) {
  const std::array<double, 4> parts{u.x, u.y, -u.x, -u.y};
  return parts[static_cast<std::size_t>(side)];
}

/// Where a place on a side of one cell is in the cell beyond.
Vec2 beyond(Vec2 p, Side side, double cell_m) {
  switch (side) {
    case Side::right:
      return {0.0, p.y};
    case Side::top:
      return {p.x, 0.0};
    case Side::left:
      return {cell_m, p.y};
    default:
      return {p.x, cell_m};
  }
}

bool is_upright(Side side) { return side == Side::right || side == Side::left; }

}  // namespace

std::size_t SampledFlow::place_of_flight(Id flight) const {
  return is_node(flight) ? flight / (4 * per_side_) : (flight - nodes_) / per_cell_;
}

/// Spread over the cell and the headings by the additive recurrence of the plastic numbers (Roberts
/// 2018), shifted at random from cell to cell.
CellState SampledFlow::state_of_start(Id flight) const {
  static constexpr std::array<double, 3> step{0.8191725133961645, 0.6710436067037893,
                                              0.5497004779019703};
  const std::size_t place = place_of_flight(flight);
  const double k = (flight - nodes_) % per_cell_;
  Random random = Random::stream(0x1a7e, place);
  const auto coordinate = [&](double alpha) {
    const double x = random.unit() + k * alpha;
    return x - std::floor(x);
  };
  const double x = coordinate(step[0]);
  const double y = coordinate(step[1]);
  const double h = coordinate(step[2]);
  return {{x * shape_.cell_m, y * shape_.cell_m},
          Direction::of(Heading::from_rad(two_pi * h - pi))};
}

/// Where a flight begins. False: nowhere, for a node on a side by which its command does not lead.
bool SampledFlow::take_off(Id flight, const std::vector<Direction>& commands, Airborne& at) const {
  const std::size_t place = place_of_flight(flight);
  if (!is_node(flight)) {
    at = {place, state_of_start(flight), 0};
    return true;
  }
  const Id number = flight % (4 * per_side_);
  const auto side = static_cast<Side>(number / per_side_);
  const Direction command = commands[place];
  if (!(outward(command.unit, side) > 0.0)) return false;
  const double along = (number % per_side_ + 0.5) / per_side_ * shape_.cell_m;
  const Vec2 p = is_upright(side) ? Vec2{0.0, along} : Vec2{along, 0.0};
  at = {place + step(side), {beyond(p, side, shape_.cell_m), command}, 0};
  return true;
}

/// Moves on into the next cell by `exit`, or returns where the flight ends.
SampledFlow::Id SampledFlow::cross(Airborne& at, const CellExit& exit, bool commanded) const {
  const double d = shape_.cell_m;
  const std::size_t next = at.place + step(exit.side);
  const bool aligned = commanded && (exit.path == CellPath::arc_then_straight || exit.turn == 0);
  if (aligned && kind_[at.place] == CellKind::target) return reaches;
  const Vec2 p = exit.state.position_m;
  if (aligned && kind_[next] == CellKind::ordinary) {
    const double along = (is_upright(exit.side) ? p.y : p.x) / d * per_side_;
    const Id number = std::min(static_cast<Id>(along), per_side_ - 1);
    return first_node(at.place) + static_cast<Id>(exit.side) * per_side_ + number;
  }
  at = {next, {beyond(p, exit.side, d), exit.state.heading}, at.crossings + 1};
  return passing;
}

/// Flies to the end, or to the cell `until`: then it is passing.
SampledFlow::Id SampledFlow::fly_on(Airborne& at, const std::vector<Direction>& commands,
                                    std::vector<std::uint32_t>* met, std::size_t until) const {
  for (;;) {
    const CellKind kind = kind_[at.place];
    if (kind == CellKind::target && !reaches_aligned_) return reaches;
    const bool ends = kind == CellKind::obstacle || kind == CellKind::outside;
    if (ends || at.crossings >= most_crossings_) return fails;
    if (at.place == until) return passing;
    if (met != nullptr) met->push_back(static_cast<std::uint32_t>(at.place));
    const Direction& command = commands[at.place];
    const CellExit exit = cross_cell(at.state, command, shape_);
    const Id end = cross(at, exit, command.unit != Vec2{});
    if (end != passing) return end;
  }
}

SampledFlow::Id SampledFlow::fly(Id flight, const std::vector<Direction>& commands,
                                 std::vector<std::uint32_t>* met) const {
  Airborne at;
  if (!take_off(flight, commands, at)) return nowhere;
  return fly_on(at, commands, met, 0);
}

}  // namespace fairway
