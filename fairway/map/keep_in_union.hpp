// Several keep-in fences, where being in any one is enough, as one area.
#pragma once

#include <vector>

#include "fairway/map/fence_set.hpp"

namespace fairway {

/// The union, as the rings of one polygon under the odd-number rule. Circles become polygons
/// inside them, at most `sagitta_m` away. Uses GEOS; vertices move by a few ulp at most. Throws
/// InputError when GEOS fails.
[[nodiscard]] FencePolygon keep_in_union(const std::vector<FencePolygon>& polygons,
                                         const std::vector<FenceCircle>& circles, double sagitta_m);

}  // namespace fairway
