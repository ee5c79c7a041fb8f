#include "fairway/run/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "fairway/field/distance_transform.hpp"

namespace fairway {

Clearance::Clearance(const Plan& plan)
    : grid_(plan.grid), obstacle_(plan.grid.size()), squared_cells_(plan.grid.size()) {
  for (std::size_t i = 0; i < obstacle_.size(); ++i) {
    obstacle_[i] = plan.region[i] == Region::obstacle ? 1 : 0;
    any_ = any_ || obstacle_[i] != 0;
  }
  distance_transform(obstacle_, grid_.nx, grid_.ny, {squared_cells_, {}});
}

Cell Clearance::nearest_cell(Vec2 place_m) const {
  const Cell c = grid_.cell_of(place_m);
  return {std::clamp(c.ix, 0, grid_.nx - 1), std::clamp(c.iy, 0, grid_.ny - 1)};
}

/// No more than the distance: the place is within half a diagonal of its cell's middle, and so is
/// the obstacle's nearest point of the middle of its cell.
double Clearance::bound_cells(Vec2 place_m) const {
  const auto squared = static_cast<double>(squared_cells_[grid_.index(nearest_cell(place_m))]);
  return std::max(0.0, std::sqrt(squared) - std::numbers::sqrt2);
}

double Clearance::at(Vec2 place_m) const {
  if (!any_) return std::numeric_limits<double>::infinity();
  const Cell c = nearest_cell(place_m);
  // The nearest obstacle by middles is at most so far, and a nearer one not farther by middles.
  const double middles = std::sqrt(static_cast<double>(squared_cells_[grid_.index(c)]));
  const int reach = static_cast<int>(std::ceil(middles + std::numbers::sqrt2));
  const Vec2 p{(place_m.x - grid_.x0_m) / grid_.cell_m, (place_m.y - grid_.y0_m) / grid_.cell_m};
  double least = std::numeric_limits<double>::infinity();
  for (int iy = std::max(0, c.iy - reach); iy <= std::min(grid_.ny - 1, c.iy + reach); ++iy) {
    const double dy = std::max({iy - p.y, 0.0, p.y - (iy + 1)});
    if (dy * dy >= least) continue;
    for (int ix = std::max(0, c.ix - reach); ix <= std::min(grid_.nx - 1, c.ix + reach); ++ix) {
      if (obstacle_[grid_.index({ix, iy})] == 0) continue;
      const double dx = std::max({ix - p.x, 0.0, p.x - (ix + 1)});
      least = std::min(least, dx * dx + dy * dy);
    }
  }
  return std::sqrt(least) * grid_.cell_m;
}

double Clearance::least_along(const Flight& flight) const {
  double least = at(flight.start.position_m);
  if (!any_) return least;
  // A place is no nearer than that before it less the way between: what cannot be the least is
  // stepped over.
  const double step_m = grid_.cell_m / 8.0;
  double skip_m = 0.0;
  for (const FlightSegment& piece : flight.segments) {
    double along_m = skip_m;
    for (; along_m < piece.length_m; along_m += std::max(step_m, skip_m)) {
      const Vec2 place = state_at(piece, along_m).position_m;
      const double bound_m = bound_cells(place) * grid_.cell_m;
      if (bound_m < least) least = std::min(least, at(place));
      skip_m = std::max(bound_m - least, 0.0);
    }
    skip_m = along_m - piece.length_m;
  }
  return std::min(least, at(end_of(flight).position_m));
}

}  // namespace fairway
