// One level of a ceiling: what can be claimed on its lattice, beginning with the level before.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/ceiling/ball_lattice.hpp"
#include "fairway/map/region.hpp"

namespace fairway {

/// The cells, and what `ceiling_level` needs to know of them.
struct CeilingCells {
  int nx = 0;
  int ny = 0;
  double side = 1.0;                   ///< turn radii
  std::vector<std::uint8_t> obstacle;  ///< [iy][ix]
  std::vector<std::uint8_t> goal;      ///< [iy][ix]

  /// Whether states there are asked for at all.
  [[nodiscard]] bool ordinary(std::size_t cell) const {
    return obstacle[cell] == 0 && goal[cell] == 0;
  }
};

struct CeilingLevel {
  BallLattice lattice;
  /// lattice.size(): of the states from which some control brings the vehicle to the mission, and
  /// those from which none does; and the same as steps may use it: that it holds, or (not) that
  /// whoever flew half a step to get there has touched an obstacle.
  std::vector<Radius> inside;
  std::vector<Radius> inside_after_step;
  std::vector<Radius> lost;
  std::vector<Radius> lost_after_step;
  /// lattice.cell_bins(): shares of the places at which claims were looked up.
  std::vector<float> inside_share;
  std::vector<float> lost_share;
  /// lattice.cell_bins(): 1 if a claim holds of the whole cell and bin.
  std::vector<std::uint8_t> closed;
};

/// Empty when `stop` was true before the claims of lost states had settled. `coarse` may be null.
[[nodiscard]] std::optional<CeilingLevel> ceiling_level(const CeilingCells& cells, int level,
                                                        const CeilingLevel* coarse,
                                                        const std::function<bool()>& stop);

/// Memory that claims of `ceiling_level` take at most, beside that of the level before. Distances
/// and shares come on top: nearly as much again at the first level, less at finer ones.
[[nodiscard]] std::size_t bytes_of_level(const CeilingCells& cells, int level);

}  // namespace fairway
