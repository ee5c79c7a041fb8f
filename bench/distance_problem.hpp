// Cost-to-go problems for both solvers: distances through free cells from a disc about a goal.
#pragma once

#include <cstdint>
#include <vector>

#include "fairway/base/grid.hpp"

namespace fairway::bench {

struct DistanceProblem {
  std::vector<std::uint8_t> blocked;  ///< [iy][ix], nonzero: obstacle
  int nx = 0;
  int ny = 0;
  Cell goal;
  double radius_cells = 5.0;  ///< inside it exact distances are given
};

/// The solution by eikonal_distance: cells, [iy][ix], +inf where there is no way.
[[nodiscard]] std::vector<float> eikonal_answer(const DistanceProblem& problem);

}  // namespace fairway::bench
