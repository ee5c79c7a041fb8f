// The result of a run, as JSON and in words.
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

/// "9,934 reach (99.3 %; 95 % interval 99.1 % to 99.5 %), 66 collide, 0 leave the map, 0 get
/// trapped".
[[nodiscard]] std::string outcome_words(const OutcomeCounts& counts);

/// "66 collide, 1 gets trapped": those that do not reach; empty when all do.
[[nodiscard]] std::string failure_words(const OutcomeCounts& counts);

/// The word for what is to be reached: "goal" or "path".
[[nodiscard]] const char* goal_word(const Plan& plan);

/// Cells, regions, inputs, options: what plan and run have in common.
[[nodiscard]] nlohmann::json plan_summary(const Scenario& scenario, const Plan& plan);
/// "A plan of 127 x 102 cells of 8 m: 46.9 % free, ...".
[[nodiscard]] std::string grid_words(const Plan& plan);
/// The same, and how many free cells are cut off.
[[nodiscard]] std::string plan_words(const Plan& plan);

/// Times, threads, memory: the part of a summary that differs from run to run.
void add_cost(nlohmann::json& summary, const StageClock& clock);
[[nodiscard]] std::string cost_words(const nlohmann::json& summary);

}  // namespace fairway
