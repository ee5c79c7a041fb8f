// Plans to prove, for the exact vehicle and under a contract, and the time that checking takes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/sections.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/plan/plan.hpp"

namespace fairway::bench {

struct Case {
  std::string name;
  ObstacleMap map;
  Vehicle vehicle;
  Vec2 goal_m;
};

[[nodiscard]] Case open_case();       ///< 20 x 20 cells, no obstacles
[[nodiscard]] Case obstacles_case();  ///< 60 x 60 cells, four obstacles
[[nodiscard]] Case blobs_case();      ///< 128 x 128 cells
/// Blocks of buildings with streets narrower than two turns; the goal on a square in the middle.
[[nodiscard]] Case streets_case(int side);

/// Throws std::runtime_error when the mission is refused.
[[nodiscard]] Plan plan_of(const Case& c);

/// Checks the certificate and `samples` states; at most `limit` times as long as proving holds.
void add_check_row(std::vector<Row>& rows, const Settings& settings,
                   const std::filesystem::path& file, const Took& proving, std::size_t samples,
                   double limit);

}  // namespace fairway::bench
