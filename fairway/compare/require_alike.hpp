// Whether plans can be compared at all: one world, one mission.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fairway/compare/compared_plan.hpp"

namespace fairway {

/// Throws InputError{the plan that does not fit, which one it does not fit and how} when frames or
/// missions differ, cells differ and are of different maps, or the grids do not overlap. Vehicles,
/// options, contracts, goal radii, and maps on the same cells may differ: returns a sentence for
/// each difference that readers should know of.
[[nodiscard]] std::vector<std::string> require_alike(std::span<const ComparedPlan> plans);

}  // namespace fairway
