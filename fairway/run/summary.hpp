// What a run found, as JSON and in words.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/field/field.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/run/scenario.hpp"
#include "fairway/run/stage_clock.hpp"
#include "fairway/simulate/flight_statistics.hpp"

namespace fairway {

struct RegionCells {
  std::size_t free = 0;
  std::size_t buffer = 0;
  std::size_t obstacle = 0;
  std::size_t goal = 0;
  std::size_t unreachable = 0;  ///< free, but of infinite cost
};
[[nodiscard]] RegionCells count_regions(const Plan& plan);

[[nodiscard]] nlohmann::json outcome_json(const OutcomeCounts& counts);

/// "9998 reach (99.98 %; 95 % interval 99.92 % to 99.99 %), 2 collide, 0 leave, 0 are trapped".
[[nodiscard]] std::string outcome_words(const OutcomeCounts& counts);

/// What is to be reached: "goal", or "path".
[[nodiscard]] const char* goal_word(const Plan& plan);

/// Cells, regions, inputs, options, warnings: what plan and run have in common.
[[nodiscard]] nlohmann::json plan_summary(const Scenario& scenario, const ObstacleMap& map,
                                          const Plan& plan);
[[nodiscard]] std::string plan_words(const Plan& plan);

/// Times, threads, memory: the part of a summary that differs from run to run.
void add_cost(nlohmann::json& summary, const StageClock& clock);
[[nodiscard]] std::string cost_words(const nlohmann::json& summary);

}  // namespace fairway
