// A path with fewer pieces that looks the same. A flight through a thousand cells has thousands of
// pieces, most of them shorter than a picture can show.
//
// Properties that always hold:
//   1. No point of either path is farther than `tolerance_pt` from the other path.
//   2. Each stretch (from a move) starts and ends where it did; a closed one stays closed.
//   3. Arcs that bulge by more than a third of the tolerance are kept as they are.
// Method: from an anchor a line goes on as long as one direction passes all points on the way
// within the tolerance and they move away from the anchor (Williams 1978). Cost: linear.
#pragma once

#include "fairway/report/drawing_path.hpp"

namespace fairway {

/// `tolerance_pt` > 0.
[[nodiscard]] DrawingPath thinned(const DrawingPath& path, double tolerance_pt);

/// What no picture shows: a tenth of a pixel at two pixels per point.
inline constexpr double unseen_pt = 0.05;

}  // namespace fairway
