// Sets of states in a cell, and what enters, steers and leaves it; the sides of a cell.
#pragma once

#include <algorithm>
#include <cmath>

#include "fairway/base/interval.hpp"
#include "fairway/base/short_list.hpp"
#include "fairway/vehicle/cell_shape.hpp"
#include "fairway/vehicle/side.hpp"

namespace fairway {

/// A set of states in a closed cell, in the cell's own coordinates.
struct CellEntry {
  IntervalVec2 position_m;
  IntervalVec2 heading;   ///< unit vectors
  int turn = 0;           ///< +1, -1: every state is on its circle of this sign; 0: unknown
  IntervalVec2 centre_m;  ///< of those circles
};

/// What the cell commands its states to do.
struct CellOrder {
  IntervalVec2 heading;        ///< unit vectors, one direction
  bool has_command = true;     ///< false: straight on
  bool already_there = false;  ///< the states' heading is exactly the command, the same number
};

struct CellDeparture {
  Side side = Side::right;
  Interval along_m;          ///< along the side, within [0, cell_m]
  bool low_corner = false;   ///< may pass through the corner at 0 ...
  bool high_corner = false;  ///< ... or at cell_m
  bool grazes = false;       ///< may run along the side, straight
  bool aligned = false;      ///< the heading is exactly the command
  IntervalVec2 heading;
  int turn = 0;  ///< as in CellEntry
  IntervalVec2 centre_m;
  double length_m = 0.0;
};

struct CellDepartures {
  ShortList<CellDeparture, 16> of;
  bool too_wide = false;  ///< the entry is too large for any conclusion

  const CellDeparture* begin() const { return of.begin(); }
  const CellDeparture* end() const { return of.end(); }
  int count() const { return of.size(); }
  void add(const CellDeparture& departure) {
    if (!of.add(departure)) too_wide = true;
  }
};

namespace cell_enclosure {

constexpr bool is_vertical(Side side) { return side == Side::right || side == Side::left; }
constexpr bool is_far(Side side) { return side == Side::right || side == Side::top; }
/// Components across and along a side.
inline const Interval& across(const IntervalVec2& v, Side s) { return is_vertical(s) ? v.x : v.y; }
inline const Interval& along(const IntervalVec2& v, Side s) { return is_vertical(s) ? v.y : v.x; }
inline IntervalVec2 from_parts(Interval across, Interval along, Side s) {
  return is_vertical(s) ? IntervalVec2{across, along} : IntervalVec2{along, across};
}
/// Places this near an end of a side also count as its corner, so that other arithmetic, whose
/// rounding differs, never hits a corner this code did not account for.
inline double corner_reach_m(double cell_m) { return cell_m * 0x1p-34; }
inline double line_of(Side side, double cell_m) { return is_far(side) ? cell_m : 0.0; }
/// Outward component.
inline Interval outward_part(const IntervalVec2& v, Side s) {
  return is_far(s) ? across(v, s) : -across(v, s);
}

/// Upper bound of the angle between unit vectors less than 180 degrees apart, one of each set.
/// Huygens: 3 x <= 2 sin x + tan x, for x half the angle; sin and cos of x from the cosine.
inline double angle_bound(const IntervalVec2& a, const IntervalVec2& b) {
  const double cosine = std::clamp(dot(a, b).lo, -1.0, 1.0);
  const double half_cos = below(std::sqrt(below(0.5 * below(1.0 + cosine))));
  const double half_sin = above(std::sqrt(above(0.5 * above(1.0 - cosine))));
  if (!(half_cos >= 0.1)) return 3.2;  // possibly NaN, the root of a negative number
  return above(2.0 / 3.0 * above(above(2.0 * half_sin) + above(half_sin / half_cos)));
}

}  // namespace cell_enclosure

}  // namespace fairway
