// How long the stages of a run will take.
#pragma once

#include <algorithm>

#include "fairway/base/grid.hpp"
#include "fairway/run/scenario.hpp"

namespace fairway {

/// Seconds that the stages after the map will take, from rates seen on one machine with two cores:
/// no more than what a progress line needs.
struct Estimate {
  double field_s, plan_s, flights_s, pictures_s, page_s;
  double from_field() const { return field_s + from_plan(); }
  double from_plan() const { return plan_s + from_flights(); }
  double from_flights() const { return flights_s + from_pictures(); }
  double from_pictures() const { return pictures_s + page_s; }
};

[[nodiscard]] inline Estimate estimate(const Scenario& scenario, const Grid& grid) {
  const auto cells = static_cast<double>(grid.size());
  const auto flights =
      static_cast<double>(std::max(scenario.simulate.random, scenario.simulate.sample));
  return {120e-9 * cells, 30e-9 * cells, flights * (grid.nx + grid.ny) * 100e-9,
          0.5 + 500e-9 * cells, 0.2 + 20e-6 * cells};
}

}  // namespace fairway
