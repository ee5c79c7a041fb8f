// Finds the ceiling: level by level, until the bracket is narrow enough.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "fairway/ceiling/ceiling.hpp"
#include "fairway/map/region.hpp"

namespace fairway {

struct CeilingOptions {
  double gap_max = 0.03;          ///< stop once the bracket of all states is no wider; (0, 1)
  int levels_max = 3;             ///< and at the latest after so many levels; 1 to 5
  double time_limit_s = 600.0;    ///< of the clock; what was found by then still holds
  double memory_limit_mb = 4096;  ///< a level that would take more is not begun
};

/// Told after each level, and asked now and then whether to give up (true).
struct CeilingProgress {
  std::function<void(const CeilingShare& all, int levels)> level;
  std::function<bool()> stop;
};

/// The mission is to enter a cell of region `goal` (of a path: a cell that it crosses) without
/// touching an obstacle or leaving the grid before. `region` is [iy][ix].
[[nodiscard]] Ceiling find_ceiling(const Grid& grid, const std::vector<Region>& region,
                                   const Vehicle& vehicle, const CeilingOptions& options = {},
                                   const CeilingProgress& progress = {});

}  // namespace fairway
