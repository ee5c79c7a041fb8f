// For tests: how far a heading is from where a set of headings ends.
#pragma once

#include <algorithm>
#include <cmath>

#include "fairway/cellular/border_heading_set.hpp"

namespace fairway {

/// From the nearest end of a range, rad; infinite without ranges.
inline double from_nearest_end(const HeadingSet& set, double rad) {
  double nearest = INFINITY;
  for (const HeadingRange& range : set) {
    for (const double at : {range.from_rad, range.to_rad()})
      nearest = std::min(nearest, std::abs(std::remainder(rad - at, two_pi)));
  }
  return nearest;
}

}  // namespace fairway
