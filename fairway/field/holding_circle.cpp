#include "fairway/field/holding_circle.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "fairway/base/heading.hpp"
#include "fairway/field/complete_map.hpp"
#include "fairway/field/follow_field.hpp"

namespace fairway {
namespace {

constexpr double least_radii = 1.2;   // a tighter circle leaves the vehicle nothing to correct with
constexpr double from_border = 0.25;  // of a cell
constexpr double overshoot_radii = 0.25;

}  // namespace

double holding_radius_m(const Grid& grid, const Vehicle& vehicle) {
  // From the centre of a cell, borders lie half a cell beyond whole numbers of cells.
  const double cells = least_radii * vehicle.turn_radius_m / grid.cell_m;
  const double nearest = std::round(cells);
  if (std::abs(cells - nearest) <= 0.5 - from_border) return cells * grid.cell_m;
  return (std::ceil(cells) - (0.5 - from_border)) * grid.cell_m;
}

double holding_room_m(const Grid& grid, const Vehicle& vehicle) {
  constexpr double half_diagonal = 0.7072;
  return holding_radius_m(grid, vehicle) + overshoot_radii * vehicle.turn_radius_m +
         half_diagonal * grid.cell_m;
}

PathMission path_of(const HoldingPlace& place) {
  constexpr int pieces = 120;
  PathMission path;
  path.closed = true;
  const double side = place.side == Rotation::left ? 1.0 : -1.0;
  for (int k = 0; k < pieces; ++k) {
    const Heading way = Heading::from_rad(side * k * two_pi / pieces);
    path.vertices_m.push_back(place.center_m + place.radius_m * way.unit());
  }
  return path;
}

void follow_circle(const Grid& grid, const std::vector<Region>& region, const HoldingPlace& place,
                   const std::vector<float>& cost_cells, const Vehicle& vehicle,
                   VectorField& field) {
  // On a piece of the grid about it: there may be many circles.
  const double far_m = place.radius_m + 5.0 * vehicle.turn_radius_m + grid.cell_m;
  const Vec2 reach{far_m, far_m};
  Cell low = grid.cell_of(place.center_m - reach);
  Cell high = grid.cell_of(place.center_m + reach);
  low = {std::max(0, low.ix), std::max(0, low.iy)};
  high = {std::min(grid.nx - 1, high.ix), std::min(grid.ny - 1, high.iy)};
  const Vec2 corner = grid.corner(low);
  const Grid piece{high.ix - low.ix + 1, high.iy - low.iy + 1, corner.x, corner.y, grid.cell_m};
  CompleteMap near;
  near.region.resize(piece.size());
  std::vector<float> cost_near(piece.size());
  VectorField field_near(piece.size());
  const auto of = [&](std::size_t k) {
    const Cell c = piece.cell_at(k);
    return grid.index({c.ix + low.ix, c.iy + low.iy});
  };
  for (std::size_t k = 0; k < piece.size(); ++k) {
    const std::size_t i = of(k);
    near.region[k] = region[i];
    cost_near[k] = cost_cells[i];
    field_near.x[k] = field.x[i];
    field_near.y[k] = field.y[i];
  }
  follow_field(piece, near, path_of(place), cost_near, vehicle, field_near);
  for (std::size_t k = 0; k < piece.size(); ++k) {
    field.x[of(k)] = field_near.x[k];
    field.y[of(k)] = field_near.y[k];
  }
}

HoldingPlace holding_place_at(const Grid& grid, Vec2 goal_m, const Vehicle& vehicle) {
  Cell cell = grid.cell_of(goal_m);
  cell = {std::min(cell.ix, grid.nx - 1), std::min(cell.iy, grid.ny - 1)};
  return {grid.center(cell), holding_radius_m(grid, vehicle), Rotation::left};
}

}  // namespace fairway
