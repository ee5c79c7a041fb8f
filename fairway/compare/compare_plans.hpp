// Plans side by side, over all states.
//
// Properties that always hold:
//   1. All plans are asked about the same states. A plan compared with itself differs in nothing;
//      plans in another order change signs and places, nothing else.
//   2. What a certificate says is proved of each state; costs are of flights, evidence.
//   3. The result does not depend on threads, but for last digits of means.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "fairway/compare/comparison.hpp"
#include "fairway/run/shortest_bound.hpp"
#include "fairway/run/stage_clock.hpp"

namespace fairway {

struct CompareOptions {
  std::size_t states = 40'000;  ///< at least 1000; sampled
  std::uint64_t seed = 1;
  int map_across = 128;  ///< samples of a difference map along its longer side
  int map_headings = 24;
  /// What the lengths of flights under a plan are compared with.
  std::function<LengthBound(const Plan& plan)> bound = line_around_obstacles;
};

/// Throws InputError as require_alike() does, or when the plans have no state in common. At least
/// two plans, with names.
[[nodiscard]] Comparison compare_plans(std::span<const ComparedPlan> plans,
                                       const CompareOptions& options, StageClock& clock);

/// One plan over its own states.
[[nodiscard]] PlanMeasures measure_plan(const ComparedPlan& plan, const CompareOptions& options,
                                        StageClock& clock);

}  // namespace fairway
