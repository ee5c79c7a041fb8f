// Where places lie beside a path: how far away, where along it, and which ways it runs there.
#pragma once

#include <vector>

#include "check/contract_parts.hpp"
#include "check/shape.hpp"

namespace fairway_check {

class PathPlaces {
 public:
  /// Of at least two vertices. Throws Defect 1 when it has no length.
  PathPlaces(const std::vector<Point>& vertices, bool closed);

  struct Near {
    double distance;
    double station;      ///< from the first vertex along the path
    double heading_rad;  ///< of the piece
  };
  Near nearest(Point at) const;
  /// The arc over the headings of all pieces that come within `radius` of a place.
  Arc directions(Point at, double heading_rad, double radius) const;
  double length() const { return length_; }

 private:
  struct Piece {
    Point from;
    Point along;  ///< of length 1
    double length;
    double station;
    double heading_rad;
  };
  static double place_on(const Piece& piece, Point at);
  static double distance_to(const Piece& piece, Point at);

  std::vector<Piece> pieces_;
  double length_ = 0.0;
};

}  // namespace fairway_check
