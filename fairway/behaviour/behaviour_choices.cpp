#include "fairway/behaviour/behaviour_choices.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/behaviour/cells_around.hpp"
#include "fairway/vehicle/filled_commands.hpp"

namespace fairway {
namespace {

std::vector<bool> cells_near_goal(const Flow& flow) {
  std::vector<bool> near(flow.grid.size());
  for (std::size_t i = 0; i < flow.grid.size(); ++i) {
    if (flow.kind[i] != CellKind::target) continue;
    const Cell c = flow.grid.cell_at(i);
    for (int iy = c.iy - 1; iy <= c.iy + 1; ++iy) {
      for (int ix = c.ix - 1; ix <= c.ix + 1; ++ix) {
        if (flow.grid.contains({ix, iy})) near[flow.grid.index({ix, iy})] = true;
      }
    }
  }
  return near;
}

}  // namespace

BehaviourChoices::BehaviourChoices(const Flow& flow, const VehicleContract& contract, double step_m)
    : flow_(flow),
      contract_(contract),
      commands_(filled_commands(flow.grid, flow.heading_rad)),
      near_goal_(cells_near_goal(flow)),
      step_m_(std::min(0.4 * flow.grid.cell_m, 0.15 * contract.turn_radius_m.least)) {
  if (step_m > 0.0) {
    step_m_ = std::min({step_m, 0.8 * flow.grid.cell_m, 0.35 * contract.turn_radius_m.least});
  }
  const Grid& g = flow.grid;
  const double size_m = std::abs(g.x0_m) + std::abs(g.y0_m) + g.width_m() + g.height_m();
  // Flights have at most some ten thousand steps; each adds roundings of the coordinates' size.
  margin_m_ = 1e-6 * g.cell_m + 1e-10 * size_m;
  double length_m = step_m_;
  for (std::vector<StepTurn>& turns : turns_) {
    const auto [least, most] = contract.turn_radius_m;
    for (const double radius_m : {least, most}) {
      if (!turns.empty() && most <= least) break;
      const double angle = length_m / radius_m;
      turns.push_back({radius_m, angle, std::cos(angle), std::sin(angle)});
    }
    length_m *= 0.5;
  }
}

CellKind BehaviourChoices::met(Vec2 from, Vec2 to) const {
  const Grid& g = flow_.grid;
  const Cell at = g.cell_of(to);
  if (!g.contains(at) || near_goal_[g.index(at)]) {
    const double angle = step_m_ / contract_.turn_radius_m.least;
    const double bulge = 0.125 * contract_.turn_radius_m.least * angle * angle;
    const CellRange cells = cells_around(g, from, to, bulge + margin_m_);
    for (int iy = cells.y0; iy <= cells.y1; ++iy) {
      for (int ix = cells.x0; ix <= cells.x1; ++ix) {
        if (flow_.kind_at({ix, iy}) == CellKind::target) return CellKind::target;
      }
    }
  }
  const CellKind kind = surely_in(to);
  return kind == CellKind::target ? CellKind::ordinary : kind;
}

CellKind BehaviourChoices::surely_in(Vec2 place) const {
  const Grid& g = flow_.grid;
  const CellRange cells = cells_around(g, place, place, margin_m_);
  if (cells.x1 < 0 || cells.y1 < 0 || cells.x0 >= g.nx || cells.y0 >= g.ny) {
    return CellKind::outside;
  }
  const CellKind kind = flow_.kind_at({cells.x0, cells.y0});
  return cells.is_one() && kind != CellKind::outside ? kind : CellKind::ordinary;
}

}  // namespace fairway
