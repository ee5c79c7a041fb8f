// Whether a plan has the properties that plan.hpp promises: what plan_defect() of plan_file.hpp
// asks of sizes and places, before there are cells. Private to the stage.
#pragma once

#include <string>

#include "fairway/base/grid.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// Which of them is out of range, in one sentence; empty when none is.
[[nodiscard]] std::string geometry_defect(const Grid& grid, const Vehicle& vehicle);

}  // namespace fairway
