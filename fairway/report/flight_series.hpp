// The two curves of paper 1's figures, from a recorded flight.
#pragma once

#include <string>

#include "fairway/report/draw_chart.hpp"
#include "fairway/simulate/flight.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway {

/// Heading against time (Figs. 6b, 8a): seconds, radians, unwrapped, that is, without jumps of
/// 2 pi; the final leg, if there is one, goes on. Exact: one point at each end of every piece.
[[nodiscard]] ChartSeries heading_over_time(const Flight& flight, double speed_mps,
                                            std::string name);

/// The same headings for a chart in degrees, in (-180, 180], the line broken where it passes 180.
[[nodiscard]] ChartSeries wrapped_degrees(const ChartSeries& headings);

/// Distance from the mission's path against time (Figs. 7b, 8b): seconds, metres, sampled at least
/// every `step_m` along the flight and at each end of every piece.
[[nodiscard]] ChartSeries path_distance_over_time(const Flight& flight, double speed_mps,
                                                  const PathMission& path, double step_m,
                                                  std::string name);

}  // namespace fairway
