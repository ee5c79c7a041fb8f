#include "fairway/run/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fairway {
namespace {

constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();
constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace

Clearance::Clearance(const Plan& plan)
    : grid_(plan.grid), left_(plan.grid.size(), none), right_(plan.grid.size(), none) {
  for (int iy = 0; iy < grid_.ny; ++iy) {
    const auto mark = [&](std::vector<std::int32_t>& columns, int ix, int before) {
      std::int32_t& here = columns[grid_.index({ix, iy})];
      if (plan.region[grid_.index({ix, iy})] == Region::obstacle) {
        here = 0;
        any_ = true;
      } else if (before >= 0 && before < grid_.nx) {
        const std::int32_t there = columns[grid_.index({before, iy})];
        if (there != none) here = there + 1;
      }
    };
    for (int ix = 0; ix < grid_.nx; ++ix) mark(left_, ix, ix - 1);
    for (int ix = grid_.nx; ix-- > 0;) mark(right_, ix, ix + 1);
  }
}

/// From `x`, in cells, in column ix, to the obstacles of a row, along it.
double Clearance::squared_in_row(int iy, int ix, double x) const {
  const std::int32_t left = left_[grid_.index({ix, iy})];
  const std::int32_t right = right_[grid_.index({ix, iy})];
  double least = infinite;
  if (left != none) least = std::max(x - (ix - left + 1), 0.0);
  if (right != none) least = std::min(least, std::max(ix + right - x, 0.0));
  return least * least;
}

double Clearance::at(Vec2 place_m) const {
  if (!any_) return infinite;
  const Vec2 p{(place_m.x - grid_.x0_m) / grid_.cell_m, (place_m.y - grid_.y0_m) / grid_.cell_m};
  const int ix = std::clamp(static_cast<int>(std::floor(p.x)), 0, grid_.nx - 1);
  const int iy = std::clamp(static_cast<int>(std::floor(p.y)), 0, grid_.ny - 1);
  double least = infinite;
  const auto look = [&](int row) {
    const double dy = std::max({row - p.y, 0.0, p.y - (row + 1)});
    if (dy * dy >= least) return false;
    least = std::min(least, dy * dy + squared_in_row(row, ix, p.x));
    return true;
  };
  for (int row = iy; row < grid_.ny && look(row);) ++row;
  for (int row = iy - 1; row >= 0 && look(row);) --row;
  return std::sqrt(least) * grid_.cell_m;
}

double Clearance::least_along(const Flight& flight) const {
  double least = at(flight.start.position_m);
  if (!any_) return least;
  // A place is no nearer than one before it less the way between.
  const double step_m = grid_.cell_m / 8.0;
  double ahead_m = 0.0;  // to the next place to look at, from the start of the piece
  for (const FlightSegment& piece : flight.segments) {
    while (ahead_m < piece.length_m) {
      const double here = at(state_at(piece, ahead_m).position_m);
      least = std::min(least, here);
      ahead_m += std::max(step_m, here - least);
    }
    ahead_m -= piece.length_m;
  }
  return std::min(least, at(end_of(flight).position_m));
}

}  // namespace fairway
