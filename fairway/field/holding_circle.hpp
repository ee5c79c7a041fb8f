// Circles on which a vehicle waits: how large, how much room they need, and the line to follow.
#pragma once

#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/field/vector_field.hpp"
#include "fairway/map/region.hpp"
#include "fairway/vehicle/holding_place.hpp"
#include "fairway/vehicle/mission.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// The radius of circles about the centres of cells: the least of at least 1.2 turning radii that
/// keeps away from the cells' borders where the circle runs along an axis, by a quarter of a cell.
/// There commands are on the axis, and a vehicle that flies exactly along a border belongs to both
/// of its cells: what it does could not be proved.
[[nodiscard]] double holding_radius_m(const Grid& grid, const Vehicle& vehicle);

/// How far from the circle's centre vehicles come that circle there: no other cell's centre may be
/// nearer.
[[nodiscard]] double holding_room_m(const Grid& grid, const Vehicle& vehicle);

/// The circle as a path that is flown round and round.
[[nodiscard]] PathMission path_of(const HoldingPlace& place);

/// Sets the commands near the circle so that it is followed as a path is (follow_field.hpp).
/// `cost_cells`: the way to the circle.
void follow_circle(const Grid& grid, const std::vector<Region>& region, const HoldingPlace& place,
                   const std::vector<float>& cost_cells, const Vehicle& vehicle,
                   VectorField& field);

/// Where the vehicle of a mission that holds circles: about the cell that its goal lies in.
[[nodiscard]] HoldingPlace holding_place_at(const Grid& grid, Vec2 goal_m, const Vehicle& vehicle);

}  // namespace fairway
