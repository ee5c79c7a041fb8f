// The question: what flights should reach.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/map/region.hpp"
#include "fairway/verify/flow.hpp"

namespace fairway {

/// It replaces the goal: with another region, goal cells are ordinary cells; with obstacles,
/// touching one counts as reaching.
/// An obstacle is never part of a rectangle or of a region of cells.
struct RegionOfInterest {
  enum class Kind { goal, obstacle, rectangle, cells };
  Kind kind = Kind::goal;
  std::array<double, 4> rectangle_m{};  ///< x0, y0, x1, y1; cells wholly inside
  std::vector<std::uint8_t> cells{};    ///< kind cells: [iy][ix], not 0 where it is
  friend bool operator==(const RegionOfInterest&, const RegionOfInterest&) = default;
};

/// What each cell means for flights to `interest`, [iy][ix]. Throws PreconditionViolation when a
/// region of cells has not one entry per cell.
[[nodiscard]] std::vector<CellKind> cell_kinds(const Grid& grid, const std::vector<Region>& region,
                                               const RegionOfInterest& interest);

/// 1 for the cells to be reached, [iy][ix].
[[nodiscard]] std::vector<std::uint8_t> target_cells(const Grid& grid,
                                                     const std::vector<Region>& region,
                                                     const RegionOfInterest& interest);

}  // namespace fairway
