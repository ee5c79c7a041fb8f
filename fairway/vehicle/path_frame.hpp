// A place as its path sees it: how far along, how far to the side, and which way the path runs
// there. Everything is exact for the polyline, up to rounding; PathLocator::frame computes it.
#pragma once

#include "fairway/base/vec2.hpp"

namespace fairway {

/// The frame of the path's point nearest to a place (of equally near ones the first along it).
///
/// On the outer side of a vertex every place in the wedge between the two pieces' normals has the
/// vertex as its nearest point. There the tangent turns from one piece's to the next one's, always
/// perpendicular to the offset, so that station, offset and tangent are continuous except where two
/// points of the path are equally near: inside of bends, and across from itself.
struct PathFrame {
  double station_m = 0.0;  ///< along the path from its first vertex; [0, length]
  double offset_m = 0.0;   ///< signed distance to the path, positive to the left of its direction
  Vec2 tangent{1.0, 0.0};  ///< unit vector
  /// Where the nearest point is an end of an open path: how far the place lies beyond it, along
  /// the tangent; never negative. Before the start it counts, too; 0 everywhere else.
  double beyond_m = 0.0;
};

}  // namespace fairway
