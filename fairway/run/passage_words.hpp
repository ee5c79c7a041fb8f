// What cuts free cells off from the goal, in a sentence: where, how wide, and what would open it.
#pragma once

#include <string>

#include "fairway/field/passages.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/run/scenario.hpp"

namespace fairway {

/// Of a plan made of this scenario on this map. Cost: n log n in cells; for plans with cells that
/// are cut off.
[[nodiscard]] CutOff cut_off_in(const Scenario& scenario, const ObstacleMap& map, const Plan& plan);

/// "The widest passage that is too narrow is at (12.3, 45.6), latitude ..., longitude ...: it is
/// 8 m wide from obstacle cell to obstacle cell, but the buffers on both sides take 10 m; alpha =
/// 1.599 or turn_radius_m = 1.999 would open it for 95 % of the cells that are cut off." Also says
/// what is walled off; empty if nothing is cut off. Whole sentences with full stops.
[[nodiscard]] std::string passage_words(const CutOff& cut_off, const Frame& frame);

}  // namespace fairway
