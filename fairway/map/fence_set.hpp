// What every vector reader returns: areas to keep out of and areas to stay in, in metres.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fairway/base/vec2.hpp"
#include "fairway/map/obstacle_map.hpp"

namespace fairway {

/// Rings without the repeated last vertex, of either orientation. A point is inside when it is
/// within an odd number of rings: the outer one first, then its holes.
struct FencePolygon {
  std::vector<std::vector<Vec2>> rings_m;
};

struct FenceCircle {
  Vec2 center_m;
  double radius_m = 0.0;
};

struct FenceSet {
  std::vector<FencePolygon> keep_out;
  std::vector<FenceCircle> keep_out_circles;
  std::vector<FencePolygon> keep_in;
  std::vector<FenceCircle> keep_in_circles;
  std::vector<Vec2> places_m;  ///< what the world must also contain: mission items, drawn lines
  std::optional<GeoReference> geo;
  std::vector<InputFile> inputs;
  std::vector<std::string> warnings;

  bool names_a_place() const {
    return !keep_out.empty() || !keep_out_circles.empty() || !keep_in.empty() ||
           !keep_in_circles.empty() || !places_m.empty();
  }
};

}  // namespace fairway
