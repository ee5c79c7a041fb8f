#include "fairway/behaviour/witness_csv.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

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

std::string witness_csv(const Flow& flow, std::span<const float> commands,
                        const VehicleContract& contract, const BehaviourFlight& flight) {
  const Grid& grid = flow.grid;
  std::string text =
      "time_s,x_m,y_m,heading_rad,curvature_per_m,radius_m,command_rad,command_x_m,command_y_m\n";
  Vec2 place = flight.start.position_m;
  double heading_rad = flight.start.heading.rad();
  double time_s = 0.0;
  const auto add_state = [&] {
    text += fmt::format("{},{},{},{}", time_s, place.x, place.y, heading_rad);
  };
  for (const BehaviourStep& step : flight.steps) {
    const Vec2 ahead =
        place + contract.look_ahead_m * Vec2{std::cos(heading_rad), std::sin(heading_rad)};
    const Cell own = grid.cell_of(ahead);
    const std::size_t cell = step.cell != own_cell ? step.cell
                             : grid.contains(own)  ? grid.index(own)
                                                   : commands.size();
    const bool known = cell < commands.size();
    const Vec2 asked = known && step.cell != own_cell ? place_in(grid, cell, ahead) : ahead;
    double command_rad = heading_rad;
    if (step.turn != 0 && known) {
      command_rad = Heading::from_rad(static_cast<double>(commands[cell]) + step.error_rad).rad();
    }
    add_state();
    text +=
        step.turn == 0 ? ",0," : fmt::format(",{},{}", step.turn / step.radius_m, step.radius_m);
    text += fmt::format(",{},{},{}\n", command_rad, asked.x, asked.y);
    time_s += length_of(step, heading_rad) / flow.vehicle.speed_mps;
    place = place + move_of(step, heading_rad);
    heading_rad = step.heading_rad;
  }
  add_state();
  return text + ",,,,,\n";
}

}  // namespace fairway
