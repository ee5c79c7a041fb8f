#include "fairway/run/cell_size_warning.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/map/read_map.hpp"
#include "fairway/run/mission_on_map.hpp"
#include "fairway/run/only_connected.hpp"

namespace fairway {
namespace {

/// Square metres that are joined to the mission.
double joined_ground_m2(ObstacleMap map, const Mission& mission) {
  keep_only_connected(map, mission, "");
  const auto free = std::count(map.obstacle.begin(), map.obstacle.end(), 0);
  return static_cast<double>(free) * map.grid.cell_m * map.grid.cell_m;
}

}  // namespace

std::optional<std::string> cell_size_warning(const Scenario& scenario, const ObstacleMap& map,
                                             const Mission& mission) {
  constexpr double coarse_radii = 0.4;
  constexpr double worth_telling = 1.1;
  const double cell_m = map.grid.cell_m;
  if (cell_m <= coarse_radii * scenario.vehicle.turn_radius_m) return std::nullopt;
  MapRequest finer = map_request(scenario);
  finer.cell_m = 0.5 * cell_m;
  const double now_m2 = joined_ground_m2(map, mission);
  if (now_m2 == 0.0) return std::nullopt;  // the mission is refused, for a better reason
  double gain = 1.0;
  try {
    gain = joined_ground_m2(read_map(finer), mission) / now_m2;
  } catch (const InputError&) {
    return std::nullopt;  // too many cells, for example: the map as asked for is the answer
  }
  if (!(gain > worth_telling)) return std::nullopt;
  return fmt::format(
      "{}: map.cell_m: cells of {} m are coarser than 0.4 turning radii; with cells of {} m, "
      "{:.0f} "
      "% more ground is joined to the mission, through passages that are closed now.",
      scenario.place_of("map.cell_m"), length_text(cell_m), length_text(0.5 * cell_m),
      100.0 * (gain - 1.0));
}

}  // namespace fairway
