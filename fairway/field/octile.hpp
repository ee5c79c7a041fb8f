// Exact shortest 8-connected paths through a region of a grid: steps of 1 and sqrt(2) cells.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fairway {

/// Cost of the cheapest 8-connected path from each cell of the region (`inside`, [iy][ix],
/// nonzero) to one of the `sources` (flat indices), in cells: the float nearest to a + b sqrt(2) of
/// an optimal path with a axial and b diagonal steps. +inf where there is none. Diagonal steps may
/// pass between two cells outside the region, as in the paper's 8-point connectivity.
/// Method: Dial's buckets of width one; label-correcting inside a bucket is not needed, since every
/// step is at least one bucket long. Cost: linear in cells.
[[nodiscard]] std::vector<float> octile_distance(std::span<const std::uint8_t> inside, int nx,
                                                 int ny, std::span<const std::uint32_t> sources);

/// Algorithms 1 and 2 of paper 1: in synchronous sweeps, each cell that touches a numbered cell
/// takes the least vertical or horizontal neighbour + 1, or, only if there is none, the least
/// diagonal neighbour + 1.41. Numbers start from `first` at the sources; `sweeps` limits the number
/// of sweeps (0: until nothing changes). Cells never numbered are +inf.
[[nodiscard]] std::vector<float> paper_wavefront(std::span<const std::uint8_t> inside, int nx,
                                                 int ny, std::span<const std::uint32_t> sources,
                                                 float first, int sweeps);

}  // namespace fairway
