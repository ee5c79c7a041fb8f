#include "fairway/simulate/chord_event.hpp"

#include <algorithm>

namespace fairway {

std::optional<Outcome> outcome_in(const Plan& plan, Cell cell) {
  if (!plan.grid.contains(cell)) return Outcome::leave;
  const Region region = plan.region[plan.grid.index(cell)];
  if (region == Region::obstacle) return Outcome::collide;
  if (region == Region::goal) return Outcome::reach;
  return std::nullopt;
}

std::optional<ChordEvent> first_event(const Plan& plan, Vec2 a, Vec2 b, bool passes_goals) {
  const Grid& grid = plan.grid;
  const auto outcome_of = [&](Cell cell) {
    const std::optional<Outcome> outcome = outcome_in(plan, cell);
    return passes_goals && outcome == Outcome::reach ? std::nullopt : outcome;
  };
  const Cell from = grid.cell_of(a);
  const Cell to = grid.cell_of(b);
  if (from == to) return std::nullopt;
  double cut_x = 1.0;
  double cut_y = 1.0;
  if (from.ix != to.ix) {
    const double x = grid.x0_m + std::max(from.ix, to.ix) * grid.cell_m;
    cut_x = std::clamp((x - a.x) / (b.x - a.x), 0.0, 1.0);
  }
  if (from.iy != to.iy) {
    const double y = grid.y0_m + std::max(from.iy, to.iy) * grid.cell_m;
    cut_y = std::clamp((y - a.y) / (b.y - a.y), 0.0, 1.0);
  }
  const double first = std::min(cut_x, cut_y);
  const double second = std::max(cut_x, cut_y);
  if (from.ix != to.ix && from.iy != to.iy) {
    const Cell between = cut_x < cut_y ? Cell{to.ix, from.iy} : Cell{from.ix, to.iy};
    if (const auto outcome = outcome_of(between)) return ChordEvent{first, *outcome};
    if (const auto outcome = outcome_of(to)) return ChordEvent{second, *outcome};
  } else if (const auto outcome = outcome_of(to)) {
    return ChordEvent{first, *outcome};
  }
  return std::nullopt;
}

}  // namespace fairway
