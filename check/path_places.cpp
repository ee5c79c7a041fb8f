#include "check/path_places.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "check/tensors.hpp"

namespace fairway_check {

PathPlaces::PathPlaces(const std::vector<Point>& vertices, bool closed) {
  const std::size_t count = closed ? vertices.size() : vertices.size() - 1;
  for (std::size_t i = 0; i < count; ++i) {
    const Point from = vertices[i];
    const Point by = vertices[(i + 1) % vertices.size()] - from;
    const double length = std::hypot(by.x, by.y);
    if (length == 0.0) continue;
    pieces_.push_back({from, (1.0 / length) * by, length, length_, std::atan2(by.y, by.x)});
    length_ += length;
  }
  require(length_ > 0.0 && std::isfinite(length_), "path_m: the path has no length");
}

double PathPlaces::place_on(const Piece& piece, Point at) {
  const Point off = at - piece.from;
  return std::clamp(off.x * piece.along.x + off.y * piece.along.y, 0.0, piece.length);
}

double PathPlaces::distance_to(const Piece& piece, Point at) {
  const Point off = at - piece.from - place_on(piece, at) * piece.along;
  return std::hypot(off.x, off.y);
}

PathPlaces::Near PathPlaces::nearest(Point at) const {
  Near near{HUGE_VAL, 0.0, 0.0};
  for (const Piece& piece : pieces_) {
    const double distance = distance_to(piece, at);
    if (distance >= near.distance) continue;
    near = {distance, piece.station + place_on(piece, at), piece.heading_rad};
  }
  return near;
}

Arc PathPlaces::directions(Point at, double heading_rad, double radius) const {
  double least = 0.0;
  double most = 0.0;
  for (const Piece& piece : pieces_) {
    if (distance_to(piece, at) > radius) continue;
    const double turn = std::remainder(piece.heading_rad - heading_rad, 2.0 * std::numbers::pi);
    least = std::min(least, turn);
    most = std::max(most, turn);
  }
  return {heading_rad + least, most - least};
}

}  // namespace fairway_check
