// The rule that makes a cell buffer (paper 1, Eq. 3), and its inverse: the buffer widths for which
// a cell stays free.
//
// With the exact metrics a cell is buffer if its centre is within alpha * r of the centre of an
// obstacle cell; with Metric::paper if Algorithm 1's wave reaches it in ceil(alpha r / cell)
// sweeps. complete_map() marks by this rule, and advice on alphas and radii uses it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fairway/field/field.hpp"
#include "fairway/map/obstacle_map.hpp"

namespace fairway {

/// How far each cell is from the nearest obstacle cell, centre to centre, in the buffer's metric.
struct Clearances {
  Grid grid;
  Metric metric = Metric::euclidean;
  /// [iy][ix]: the squared distance in cells; with Metric::paper the distance along x or y,
  /// whichever is larger, in cells. 0 on an obstacle, no_feature_distance without any.
  std::vector<std::int32_t> measure;

  [[nodiscard]] double clearance_m(std::size_t index) const;
  /// A cell is outside a buffer narrower than this, with Metric::paper also one as wide; 0: inside
  /// any. +inf without obstacles.
  [[nodiscard]] double free_width_m(std::size_t index) const;
};

[[nodiscard]] Clearances clearances(const ObstacleMap& map, Metric metric);

/// The largest measure that is still buffer when the buffer is `width_m` = alpha * r wide.
[[nodiscard]] double buffer_limit(const Grid& grid, Metric metric, double width_m);

/// Algorithm 1, line 2: at least one sweep, and no more than the map can take.
[[nodiscard]] int paper_sweeps(const Grid& grid, double width_m);

}  // namespace fairway
