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

/// What a plan is to do: Comparison::does.
[[nodiscard]] std::string does_of(const ComparedPlan& plan, Knowledge of);

}  // namespace fairway
