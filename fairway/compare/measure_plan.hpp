// A plan over given states: flights, verdicts and shares.
#pragma once

#include <functional>
#include <vector>

#include "fairway/compare/common_ground.hpp"
#include "fairway/compare/compared_plan.hpp"
#include "fairway/compare/plan_measures.hpp"
#include "fairway/run/flight_costs.hpp"
#include "fairway/run/shortest_bound.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

/// What is known of the states of a ground under one plan.
struct StatesUnderPlan {
  MeasuredFlights flown;
  std::vector<Verdict> exact;     ///< [state], proved or seen
  std::vector<Verdict> contract;  ///< [state]; empty without a contract certificate
};

/// `bound`: what lengths are compared with.
[[nodiscard]] StatesUnderPlan states_under(const ComparedPlan& plan, const CommonGround& ground,
                                           const LengthBound& bound,
                                           const std::function<void(std::size_t)>& progress = {});

[[nodiscard]] PlanMeasures measures_of(const ComparedPlan& plan, const CommonGround& ground,
                                       const StatesUnderPlan& states);

/// Which states have the property, and which count, as ratio_of_totals() takes them.
template <typename Has, typename Counts>
RateTotals share_totals(std::size_t states, const Has& has, const Counts& counts) {
  RateTotals totals;
  totals.part.resize(states);
  totals.of.resize(states);
  for (std::size_t i = 0; i < states; ++i) {
    if (!counts(i)) continue;
    totals.of[i] = 1.0;
    totals.part[i] = has(i) ? 1.0 : 0.0;
  }
  return totals;
}

/// Safe-start or buffer cells of the plan.
[[nodiscard]] bool is_in(const Plan& plan, const State& state, Region region);

}  // namespace fairway
