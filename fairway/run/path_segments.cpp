#include "fairway/run/path_segments.hpp"

namespace fairway {

std::vector<FlightSegment> segments_of(const DubinsPath& path) {
  std::vector<FlightSegment> segments;
  State at = path.start;
  for (const DubinsPart& part : parts_of(path)) {
    if (!(part.length_m > 0.0)) continue;
    segments.push_back({at, 0.0, part.length_m, part.curvature_per_m});
    at = driven(at, part.length_m, part.curvature_per_m);
  }
  return segments;
}

}  // namespace fairway
