// From a frame's metres to degrees on Earth: the way back of frame_from_degrees.hpp.
#pragma once

#include <string>

#include "fairway/base/frame.hpp"

namespace fairway {

/// Degrees of a point of the frame; empty when it has no place on Earth. The function is for one
/// thread at a time. `where` names the record in errors: InputError when its reference system is
/// not understood; the function throws it for a point outside that system.
[[nodiscard]] LonLatOf lon_lat_of(const Frame& frame, const std::string& where);

}  // namespace fairway
