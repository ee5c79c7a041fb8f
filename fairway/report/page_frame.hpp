// Where the page's places lie on Earth. Private to the library, like everything that makes JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "fairway/base/frame.hpp"
#include "fairway/base/grid.hpp"

namespace fairway {

/// {"yaw_rad": the grid's turn against its source's world, "earth": null or {"across": n,
/// "lat_deg": [n * n], "lon_deg": [n * n]}}: degrees at a lattice over the grid, [row][column], the
/// first row lowest, for the page to interpolate. Longitudes do not wrap: they may leave
/// [-180, 180]. Between its points the error is below a tenth of a metre on maps of up to 10 km.
/// `lon_lat` may be empty, and may throw InputError: there is no `earth` then.
[[nodiscard]] nlohmann::json page_frame_json(const Grid& grid, const Frame& frame,
                                             const LonLatOf& lon_lat);

}  // namespace fairway
