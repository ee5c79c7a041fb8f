// What is to be reached, as Python says it.
#pragma once

#include "binding.hpp"
#include "fairway/verify/region_of_interest.hpp"

namespace fairway::python {

/// "goal", "obstacle", (x0, y0, x1, y1), a mask [ny, nx] of bool, a polygon [n, 2], or a path.
/// TypeError, ValueError or InputError say what is expected instead.
[[nodiscard]] RegionOfInterest region_from(const py::object& region, const Plan& plan);

}  // namespace fairway::python
