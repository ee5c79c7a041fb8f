// Shortest distances through a region of a grid: the eikonal equation |grad u| = 1.
//
// Discretisation: at every cell the least of the eight triangles of its 3 x 3 neighbourhood, each
// with linear interpolation between an axial and a diagonal neighbour (Tsitsiklis 1995; Sethian
// and Vladimirsky 2003). First order, overestimates, isotropic to 1 part in a few hundred, and
// its gradient can have any direction.
//
// Order: in a triangle whose angle at the updated cell is 45 degrees, the new value exceeds each
// value it depends on by at least 1/sqrt(2) cell. So all cells of one "wave" of thickness 2/3 cell
// are final together (Dial's buckets), no heap is needed, and the cells of a wave can be processed
// in parallel; a value is a minimum over final values, so results do not depend on threads.
// Cost: linear in cells; two square roots per cell. Limit: distances beyond 2^22 / 1.5 = 2.8
// million cells are left at +inf.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fairway/base/grid.hpp"

namespace fairway {

/// A cell from which distances grow, with its own distance (cells, >= 0).
struct EikonalSource {
  std::uint32_t index = 0;  ///< flat index [iy][ix]
  float distance_cells = 0.0F;
};

/// Distances in cells, [iy][ix]. `inside` ([iy][ix], nonzero: part of the region) bounds the
/// region; sources outside it are ignored. Returns +inf for cells that no source reaches.
/// Steps between diagonal neighbours are allowed whatever the two cells next to them are.
[[nodiscard]] std::vector<float> eikonal_distance(std::span<const std::uint8_t> inside, int nx,
                                                  int ny, std::span<const EikonalSource> sources);

}  // namespace fairway
