// How near flights come to obstacles.
//
// Properties that always hold: at() is the distance to the nearest obstacle cell (a closed square),
// 0 in one, +inf on a map without obstacles; the grid's edge is none. Several threads may ask.
// Cost: 4 bytes a cell; open space is passed in long steps.
#pragma once

#include <cstdint>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/simulate/flight.hpp"

namespace fairway {

class Clearance {
 public:
  /// Keeps nothing of `plan`. Throws PreconditionViolation as distance_transform does.
  explicit Clearance(const Plan& plan);

  [[nodiscard]] double at(Vec2 place_m) const;

  /// The least along a recorded flight: at most a sixteenth of a cell too large, never too small.
  [[nodiscard]] double least_along(const Flight& flight) const;

 private:
  Cell nearest_cell(Vec2 place_m) const;
  double bound_cells(Vec2 place_m) const;

  Grid grid_;
  std::vector<std::uint8_t> obstacle_;       // [iy][ix]
  std::vector<std::int32_t> squared_cells_;  // [iy][ix] to the nearest obstacle, between middles
  bool any_ = false;
};

}  // namespace fairway
