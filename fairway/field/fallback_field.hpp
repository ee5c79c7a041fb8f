// Commands where the mission has none: to places where the vehicle can wait (docs/field.md).
//
// Cells from which the mission is out of reach fall into connected parts. Each part gets circles
// where they fit, and commands that lead to them as the mission's lead to its goal: by the shortest
// way, out of the buffer straight to its border, and along the circles as a path is followed.
#pragma once

#include <vector>

#include "fairway/field/field.hpp"
#include "fairway/vehicle/holding_place.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// Adds commands to the cells of `field` that have none and are no obstacle; those of parts in
/// which no circle fits stay without, and so do those farthest from a circle where more than 20,000
/// cells are out of reach and more than the mission has commands for. Region, cost and all other
/// commands stay. Returns the circles. Properties that always hold:
///   1. every cell that a circling vehicle comes to is one of those that had no command;
///   2. a part has a circle if one fits about the centre of one of its cells, and further ones
///      only far from those it has.
[[nodiscard]] std::vector<HoldingPlace> add_fallback(const Vehicle& vehicle,
                                                     const FieldOptions& options, Field& field);

}  // namespace fairway
