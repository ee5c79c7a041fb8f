// The backward reachable set of a region of interest on border samples (paper 2, section V), in one
// pass: a fast equivalent of Algorithm 1's repeated sweeps (bitmap_expansion.hpp).
//
// Since every sample state has one successor, the states form a graph with one edge out of each
// node; each is followed until it meets a state whose answer is known, and the whole path gets
// that answer. So every successor is computed about once.
// Properties that always hold:
//   1. The bits are those of the successor relation (bitmap_graph.hpp), the same as the reference's
//      and the same for any number of threads.
//   2. Peak memory: two bits a state during the computation, one afterwards.
#pragma once

#include <cstdint>
#include <vector>

#include "fairway/bitmap/border_bitmap.hpp"
#include "fairway/plan/plan.hpp"

namespace fairway {

struct BitmapOptions {
  int samples = 200;  ///< m per border, of position and of heading; a multiple of 4, 4 .. 8192
};

/// `target_cells` is [iy][ix], not 0 for the region of interest (bitmap_region.hpp makes them).
/// Throws PreconditionViolation as BitmapGraph does.
[[nodiscard]] BorderBitmap backward_reachable_set(const Plan& plan,
                                                  const std::vector<std::uint8_t>& target_cells,
                                                  const BitmapOptions& options = {});

}  // namespace fairway
