// What the motion inside a cell depends on.
#pragma once

namespace fairway {

struct CellShape {
  double cell_m = 1.0;
  double turn_radius_m = 2.0;               ///< > cell_m
  double per_radius = 1.0 / turn_radius_m;  ///< rounded: for motion in doubles, not for enclosures
};

}  // namespace fairway
