// THE main flow: from a scenario to a folder with all products.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/base/atomic_file.hpp"
#include "fairway/field/field.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/run/choose_parameters.hpp"
#include "fairway/run/progress.hpp"
#include "fairway/run/scenario.hpp"
#include "fairway/run/stage_clock.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway {

struct Planned {
  ObstacleMap map;
  Mission mission;
  Plan plan;
  Scenario scenario;  ///< as it was asked for, with the parameters that were chosen
  std::vector<TriedParameters> tried;  ///< from which; empty: nothing was left open
};

/// map -> field -> plan, in memory: the first steps of every run. A refusal is `unreachable`; any
/// other problem with the mission is an InputError at the scenario's line.
[[nodiscard]] std::variant<Planned, MissionRefusal> plan_scenario(const Scenario& scenario,
                                                                  StageClock& clock);

struct RunResult {
  bool unreachable = false;  ///< nothing was written; `paragraph` says why
  nlohmann::json summary;    ///< docs/formats.md
  std::string paragraph;     ///< the result in words
  std::vector<std::string> warnings;
};

/// map -> field -> plan -> flights -> pictures -> summary.json, all in `folder`, which appears
/// whole or not at all. Products do not depend on threads, but for the times in summary.json.
/// Throws InputError for bad input, a mission the map does not allow, or an existing output.
[[nodiscard]] RunResult run(const Scenario& scenario, const std::filesystem::path& folder,
                            Existing existing, const Progress& progress);

/// map -> field -> plan alone, into one file, and into a picture where one is named.
[[nodiscard]] RunResult run_plan_only(const Scenario& scenario, const std::filesystem::path& file,
                                      Existing existing, const Progress& progress,
                                      const std::filesystem::path& picture = {});

}  // namespace fairway
