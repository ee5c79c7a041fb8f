// Why free cells are cut off from the goal, and what would connect them: the widest passage that is
// too narrow for its buffer.
//
// Of all ways from the mission's cells to the largest part that is cut off and not walled off, the
// one whose narrowest place is the widest (a path of largest bottleneck, found as Dijkstra finds
// shortest ones). Properties that always hold:
//   1. With `alpha` instead of the plan's alpha, all cells of that part can reach the mission; with
//      any larger by more than its last digit, some cannot. `alpha` holds as printed by {:.4g}.
//   2. The same holds for `turn_radius_m`, where the mission still fits; none where so tight a turn
//      would need smaller cells, or would leave the goal without a cell.
//   3. A part that is walled off stays cut off at every alpha.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "fairway/field/field.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/vehicle/mission.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

struct Passage {
  Vec2 place_m;           ///< centre of its narrowest cell
  double width_m = 0.0;   ///< twice that cell's clearance, between centres of obstacle cells
  double needed_m = 0.0;  ///< anything wider would suffice: 2 * alpha * r
  double alpha = 0.0;     ///< opens it
  std::optional<double> turn_radius_m;  ///< opens it, too
  std::size_t opens_cells = 0;          ///< free cells that would no longer be cut off
};

struct CutOff {
  std::size_t free_cells = 0;
  std::size_t cut_off_cells = 0;     ///< of these, without a way to the mission
  std::size_t walled_off_cells = 0;  ///< of these, behind obstacles without a gap
  std::optional<Passage> passage;    ///< none when only walls cut cells off

  [[nodiscard]] double share() const {
    return free_cells == 0 ? 0.0
                           : static_cast<double>(cut_off_cells) / static_cast<double>(free_cells);
  }
};

/// `region` and `cost_m` as in the field of this mission, [iy][ix]. Cost: n log n in cells.
[[nodiscard]] CutOff cut_off(const ObstacleMap& map, const Vehicle& vehicle, const Mission& mission,
                             const FieldOptions& options, std::span<const Region> region,
                             std::span<const float> cost_m);

}  // namespace fairway
