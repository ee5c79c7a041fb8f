// How near flights come to obstacles.
//
// Properties that always hold: at() is the distance to the nearest obstacle cell (a closed square),
// 0 in one, +inf on a map without obstacles; the grid's edge is none. Several threads may ask.
// Cost: 8 bytes a cell; a place takes as many steps as there are rows of cells between it and the
// obstacle, and along a flight what cannot be the least is stepped over.
#pragma once

#include <cstdint>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/simulate/flight.hpp"

namespace fairway {

class Clearance {
 public:
  /// Keeps nothing of `plan`.
  explicit Clearance(const Plan& plan);

  [[nodiscard]] double at(Vec2 place_m) const;

  /// The least along a recorded flight: at most a sixteenth of a cell too large, never too small.
  [[nodiscard]] double least_along(const Flight& flight) const;

 private:
  double squared_in_row(int iy, int ix, double x) const;

  Grid grid_;
  // [iy][ix], columns from a cell to the nearest obstacle of its row, that cell included, to the
  // left and to the right; `none` without one.
  std::vector<std::int32_t> left_;
  std::vector<std::int32_t> right_;
  bool any_ = false;
};

}  // namespace fairway
