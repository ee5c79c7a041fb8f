// From a plan's metres to degrees on Earth: the way back of frame_from_degrees.hpp.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "fairway/base/vec2.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/map/read_map.hpp"

namespace fairway {

/// Degrees of a point of the grid's frame; empty when the map had no place on Earth. The function
/// is for one thread at a time. `where` names the record in errors: InputError when its reference
/// system is not understood; the function throws it for a point outside that system.
[[nodiscard]] std::function<GeodeticPoint(Vec2 position_m)> degrees_from_frame(
    const std::optional<GeoReference>& geo, const std::optional<std::string>& projected_crs,
    const std::string& where);

}  // namespace fairway
