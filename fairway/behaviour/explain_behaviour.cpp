#include "fairway/behaviour/explain_behaviour.hpp"

#include <algorithm>
#include <cmath>

namespace fairway {
namespace {

/// The point of the cell nearest to the vehicle, or to the point ahead of it.
Vec2 place_in(const Grid& grid, std::size_t cell, Vec2 p) {
  const Vec2 low = grid.corner(grid.cell_at(cell));
  const double inset = 0x1p-20 * grid.cell_m;
  return {std::clamp(p.x, low.x + inset, low.x + grid.cell_m - inset),
          std::clamp(p.y, low.y + inset, low.y + grid.cell_m - inset)};
}

}  // namespace

ExplainedBehaviour explained(const Flow& flow, std::span<const float> commands,
                             const VehicleContract& contract, const BehaviourFlight& flight) {
  const Grid& grid = flow.grid;
  ExplainedBehaviour behaviour{{}, flight.start, 0.0};
  behaviour.steps.reserve(flight.steps.size());
  for (const BehaviourStep& step : flight.steps) {
    const Vec2 place = behaviour.end.position_m;
    const double heading_rad = behaviour.end.heading.rad();
    const Vec2 ahead =
        place + contract.look_ahead_m * Vec2{std::cos(heading_rad), std::sin(heading_rad)};
    const Cell own = grid.cell_of(ahead);
    const std::size_t cell = step.cell != own_cell ? step.cell
                             : grid.contains(own)  ? grid.index(own)
                                                   : commands.size();
    const bool known = cell < commands.size();
    double command_rad = heading_rad;
    if (step.turn != 0 && known) {
      command_rad = Heading::from_rad(static_cast<double>(commands[cell]) + step.error_rad).rad();
    }
    const double length_m = length_of(step, heading_rad);
    behaviour.steps.push_back(
        {behaviour.end, behaviour.time_s, length_m, step.turn == 0 ? 0.0 : step.radius_m, step.turn,
         command_rad, known && step.cell != own_cell ? place_in(grid, cell, ahead) : ahead});
    behaviour.time_s += length_m / flow.vehicle.speed_mps;
    behaviour.end = {place + move_of(step, heading_rad), Heading::from_rad(step.heading_rad)};
  }
  return behaviour;
}

}  // namespace fairway
