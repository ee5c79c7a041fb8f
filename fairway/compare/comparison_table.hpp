// The lines of a comparison: bad news first, then what is proved, then what flights cost.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fairway/compare/compared_plan.hpp"
#include "fairway/compare/comparison.hpp"
#include "fairway/compare/measure_plan.hpp"

namespace fairway {

/// Fills table and all_succeed of a comparison whose other members are there.
void fill_table(std::span<const ComparedPlan> plans, std::span<const StatesUnderPlan> states,
                Comparison& comparison);

/// "reach the goal", "reach the goal and stay", "touch the path".
[[nodiscard]] std::string mission_words_of(const ComparedPlan& plan);
/// Of the states that a contract certificate proves: "whatever the vehicle does within its
/// contract", "and follow it".
[[nodiscard]] std::string contract_words_of(const ComparedPlan& plan);

}  // namespace fairway
