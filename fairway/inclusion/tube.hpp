// A tube about a path, as flights over parts see it: how far each part lies from the path, where
// along it, and which ways the path runs there.
//
// Properties that always hold, for parts up to `widest_m` away:
//   1. No place of the part is farther from the path than distance_m.
//   2. The tangents of the path at the points nearest to the part's places lie in `tangents`. (Its
//      station is that of its middle.)
#pragma once

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "fairway/inclusion/heading_arc.hpp"
#include "fairway/inclusion/parts.hpp"
#include "fairway/vehicle/path_geometry.hpp"
#include "fairway/vehicle/path_locator.hpp"

namespace fairway {

class Tube {
 public:
  static constexpr float outside = std::numeric_limits<float>::infinity();

  /// `grid`: of the parts' plan. Time in proportion to parts, and to pieces of the path near them.
  Tube(const Parts& parts, const Grid& grid, const PathLocator& path, double widest_m);

  double length_m() const { return length_m_; }
  Vec2 place_m(double station_m) const;  ///< of the path
  bool closed() const { return closed_; }
  /// How much the path turns from one station to another, both ways added up: at its corners.
  double turning_rad(double from_m, double to_m) const;

  float distance_m(std::size_t part) const { return distance_m_[part]; }  ///< or `outside`
  float station_m(std::size_t part) const { return station_m_[part]; }    ///< of its middle

  const HeadingArc& tangents(std::size_t part) const { return tangents_[part]; }

  /// The largest angle between a heading of the arc and a tangent of the part.
  double off_rad(std::size_t part, const HeadingArc& headings) const;
  /// How far forward one station lies from another: of a closed path the shorter way round,
  /// negative when that leads back.
  double ahead_m(double from_m, double to_m) const;

 private:
  double length_m_;
  bool closed_;
  std::vector<PathPiece> pieces_;
  std::vector<std::pair<double, double>> corner_;  // station, rad
  std::vector<float> distance_m_;                  // [parts]
  std::vector<float> station_m_;                   // [parts]
  std::vector<HeadingArc> tangents_;               // [parts]
};

}  // namespace fairway
