// Whether a plan has the properties that plan.hpp promises.
#pragma once

#include <string>

#include "fairway/base/grid.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// Which property of plan.hpp `plan` lacks, in one sentence; empty when it has them all.
[[nodiscard]] std::string plan_defect(const Plan& plan);

/// The same of sizes and places alone.
[[nodiscard]] std::string geometry_defect(const Grid& grid, const Vehicle& vehicle);

}  // namespace fairway
