// From a frame's metres to degrees on Earth: the way back of frame_from_degrees.hpp.
#pragma once

#include <string>

#include "fairway/base/frame.hpp"

namespace fairway {

/// Converts points of the frame to degrees; empty when the frame is not georeferenced. For one
/// thread at a time. `where` names the record in errors: throws InputError when its reference
/// system is not understood; the returned function throws it for points outside that system.
[[nodiscard]] LonLatOf lon_lat_of(const Frame& frame, const std::string& where);

}  // namespace fairway
