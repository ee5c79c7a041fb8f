#include "fairway/inclusion/parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"

namespace fairway {
namespace {

/// The smallest arc that holds all of `headings` (at least one), which are sorted.
HeadingArc smallest_arc(std::vector<double>& headings) {
  std::sort(headings.begin(), headings.end());
  std::size_t after = 0;  // the widest gap ends here
  double gap = headings.front() + whole_turn_rad - headings.back();
  for (std::size_t i = 1; i < headings.size(); ++i) {
    if (headings[i] - headings[i - 1] > gap) {
      gap = headings[i] - headings[i - 1];
      after = i;
    }
  }
  return {headings[after], whole_turn_rad - gap};
}

/// An arc that ends just beyond the direction of a side is made wider: flights that come over the
/// side with the few headings beyond would not come out of the slack of its places.
HeadingArc clear_of_axes(HeadingArc arc) {
  constexpr double least_rad = 0x1p-9;
  const auto beyond = [](double angle_rad) {
    const double past = std::fmod(counted_from_zero(angle_rad), 0.5 * pi);
    return past < least_rad ? least_rad - past : 0.0;
  };
  const double below = beyond(-arc.lo_rad);
  const double above = beyond(arc.hi_rad());
  return {arc.lo_rad - below, arc.width_rad + below + above};
}

/// How far two ranges of one coordinate lie apart.
double apart(double lo, double hi, double other_lo, double other_hi) {
  return std::max({0.0, other_lo - hi, lo - other_hi});
}

}  // namespace

Parts::Parts(const Flow& flow, const VehicleContract& contract, int per_cell)
    : nx_(flow.grid.nx * per_cell),
      ny_(flow.grid.ny * per_cell),
      part_m_(flow.grid.cell_m / per_cell),
      turn_radius_{contract.turn_radius_m.least / part_m_, contract.turn_radius_m.most / part_m_},
      hold_side_rad_(contract.hold_side_rad),
      side_uncertain_rad_(contract.side_uncertain_rad),
      per_cell_(per_cell),
      kind_(flow.grid.size() * static_cast<std::size_t>(per_cell * per_cell)),
      arc_(kind_.size()) {
  require(per_cell >= 1 && per_cell <= 16, "Parts: expected 1 to 16 parts a side of a cell");
  require(contract.look_ahead_m == 0.0 && contract.wind_mps == 0.0,
          "Parts: look_ahead_m and wind_mps are 0");
  const Grid& grid = flow.grid;
  const std::vector<float> command = filled_commands(grid, flow.heading_rad);
  const double side = per_cell;  // of a cell, in parts
  const double reach = contract.command_error_m / part_m_ + 4.0 * place_slack;
  const double band = contract.heading_error_rad + 4.0 * heading_slack_rad;
  // Wider, and a command at one end may turn a heading at the other out of the arc: by the
  // uncertain side, or by a side held for a command as far on the other side.
  const double widest =
      std::min(pi - side_uncertain_rad_, 2.0 * hold_side_rad_) - 8.0 * heading_slack_rad;
  const auto cells_within = [&](double lo, double hi, int count) {
    const double far = count;
    return std::pair{static_cast<int>(std::clamp(std::floor((lo - reach) / side), 0.0, far - 1.0)),
                     static_cast<int>(std::clamp(std::floor((hi + reach) / side), 0.0, far - 1.0))};
  };
  for_ranges(static_cast<std::size_t>(ny_), 1, [&](std::size_t a, std::size_t b) {
    std::vector<double> headings;
    for (int iy = static_cast<int>(a); iy < static_cast<int>(b); ++iy) {
      for (int ix = 0; ix < nx_; ++ix) {
        const std::size_t at = index({ix, iy});
        const CellKind cell = flow.kind_at({ix / per_cell, iy / per_cell});
        kind_[at] = cell == CellKind::obstacle ? PartKind::obstacle
                    : cell == CellKind::target ? PartKind::goal
                                               : PartKind::ordinary;
        if (kind_[at] != PartKind::ordinary) continue;
        headings.clear();
        std::size_t enough = 256;
        const auto [x0, x1] = cells_within(ix, ix + 1.0, grid.nx);
        const auto [y0, y1] = cells_within(iy, iy + 1.0, grid.ny);
        for (int cy = y0; cy <= y1; ++cy) {
          const double dy = apart(iy, iy + 1.0, cy * side, (cy + 1) * side);
          for (int cx = x0; cx <= x1; ++cx) {
            const double dx = apart(ix, ix + 1.0, cx * side, (cx + 1) * side);
            if (dx * dx + dy * dy > reach * reach) continue;
            headings.push_back(
                counted_from_zero(static_cast<double>(command[grid.index({cx, cy})])));
          }
          // Of many cells: those so far may be too wide, and more make it wider.
          if (headings.size() < enough) continue;
          enough = 2 * headings.size();
          if (smallest_arc(headings).widened(band).width_rad >= widest) break;
        }
        if (std::isnan(headings.front())) {  // no cell has a command
          kind_[at] = PartKind::wild;
          continue;
        }
        arc_[at] = clear_of_axes(smallest_arc(headings).widened(band));
        if (arc_[at].width_rad >= widest) kind_[at] = PartKind::wild;
      }
    }
  });
}

void Parts::claim_nothing(Cell cell) {
  for (int iy = cell.iy * per_cell_; iy < (cell.iy + 1) * per_cell_; ++iy) {
    for (int ix = cell.ix * per_cell_; ix < (cell.ix + 1) * per_cell_; ++ix) {
      PartKind& kind = kind_[index({ix, iy})];
      if (kind == PartKind::ordinary) kind = PartKind::wild;
    }
  }
}

void Parts::close_goal() {
  std::replace(kind_.begin(), kind_.end(), PartKind::goal, PartKind::closed);
}

}  // namespace fairway
