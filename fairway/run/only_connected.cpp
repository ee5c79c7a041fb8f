#include "fairway/run/only_connected.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fmt/format.h>

#include "fairway/base/number_text.hpp"
#include "fairway/field/mission_cells.hpp"

namespace fairway {
namespace {

std::vector<std::size_t> cells_of(const Grid& grid, const Mission& mission) {
  std::vector<std::size_t> cells;
  if (const auto* goal = std::get_if<GoalMission>(&mission)) {
    const Cell cell = grid.cell_of(goal->goal_m);
    if (grid.contains(cell)) cells.push_back(grid.index(cell));
    return cells;
  }
  const auto& path = std::get<PathMission>(mission);
  for (const PathCell& cell : cells_on_path(grid, path)) cells.push_back(cell.index);
  return cells;
}

}  // namespace

void keep_only_connected(ObstacleMap& map, const Mission& mission, const std::string& file) {
  const Grid& grid = map.grid;
  std::vector<std::uint8_t> joined(grid.size());
  std::vector<std::size_t> waiting;
  const auto take = [&](std::size_t i) {
    if (map.obstacle[i] != 0 || joined[i] != 0) return;
    joined[i] = 1;
    waiting.push_back(i);
  };
  for (const std::size_t i : cells_of(grid, mission)) take(i);
  if (waiting.empty()) return;
  while (!waiting.empty()) {
    const Cell here = grid.cell_at(waiting.back());
    waiting.pop_back();
    for (const auto& [dx, dy] :
         std::array<std::array<int, 2>, 4>{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}}) {
      const Cell c{here.ix + dx, here.iy + dy};
      if (grid.contains(c)) take(grid.index(c));
    }
  }
  std::size_t free = 0;
  std::size_t left_out = 0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (map.obstacle[i] != 0) continue;
    ++free;
    if (joined[i] != 0) continue;
    ++left_out;
    map.obstacle[i] = 1;
  }
  if (left_out == 0) return;
  map.warnings.push_back(fmt::format(
      "{}: map.only_connected left out {} of {} free cells ({}), which are not connected to the "
      "mission; shares do not count them.",
      file, left_out, free,
      whole_percent_text(static_cast<double>(left_out) / static_cast<double>(free))));
}

}  // namespace fairway
