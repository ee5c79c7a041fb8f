// A vehicle steered to a pose, or along waypoints: its path with the circles of least radius at
// every pose, the shortest path to compare, and beside them a chart of the quantity that the law
// reduces to zero.
//
// Every piece of a path is drawn exactly, as an arc or a line. Both axes of the map have the same
// scale.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fairway/report/draw_chart.hpp"
#include "fairway/report/picture.hpp"
#include "fairway/simulate/flight.hpp"

namespace fairway {

struct SteeredPath {
  std::string name;                     ///< in the legend
  std::vector<FlightSegment> segments;  ///< joined end to end
};

struct SteeringPicture {
  std::string title = {};
  double turn_radius_m = 1.0;
  State start = {};
  std::vector<State> goals = {};                       ///< numbered from 1 when there are several
  SteeredPath path = {};                               ///< under the law
  std::optional<SteeredPath> compared = std::nullopt;  ///< dashed, above the other
  std::vector<ChartSeries> values = {};                ///< over the length driven; none: no chart
  std::string value_label = {};                        ///< of the chart's y axis
  double map_pt = 300.0;                               ///< longer side of the map, 100..2000
  double pixels_per_pt = 2.0;                          ///< resolution of the PNG, 0.5..8
};

/// Throws PreconditionViolation when a size is out of range, the radius is not positive, or a
/// series has unequal x and y.
[[nodiscard]] Picture draw_steering(const SteeringPicture& picture);

}  // namespace fairway
