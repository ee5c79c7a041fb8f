#include "fairway/report/flight_series.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "fairway/base/error.hpp"
#include "fairway/vehicle/path_geometry.hpp"

namespace fairway {
namespace {

/// The place `s_m` along a piece of constant curvature, by the chord: exact also when nearly
/// straight.
Vec2 position_along(const FlightSegment& piece, double s_m) {
  const double half_turn = 0.5 * piece.curvature_per_m * s_m;
  const double chord_m = half_turn == 0.0 ? s_m : s_m * std::sin(half_turn) / half_turn;
  return piece.start.position_m +
         chord_m * Heading::from_rad(piece.start.heading.rad() + half_turn).unit();
}

}  // namespace

ChartSeries heading_over_time(const Flight& flight, double speed_mps, std::string name) {
  require(speed_mps > 0.0, "a speed is positive");
  ChartSeries series{std::move(name), {}, {}, {}};
  double heading_rad = flight.start.heading.rad();
  for (const auto& segments : {std::span(flight.segments), std::span(flight.final_leg.segments)}) {
    for (const FlightSegment& piece : segments) {
      // The nearest of the angles that mean this heading: no jump of 2 pi.
      heading_rad += Heading::from_rad(heading_rad).turn_to(piece.start.heading);
      series.x.push_back(piece.time_s);
      series.y.push_back(heading_rad);
      heading_rad += piece.curvature_per_m * piece.length_m;
      series.x.push_back(piece.time_s + piece.length_m / speed_mps);
      series.y.push_back(heading_rad);
    }
  }
  return series;
}

ChartSeries path_distance_over_time(const Flight& flight, double speed_mps, const PathMission& path,
                                    double step_m, std::string name) {
  require(speed_mps > 0.0 && step_m > 0.0, "a speed and a step are positive");
  ChartSeries series{std::move(name), {}, {}, {}};
  for (const FlightSegment& piece : flight.segments) {
    const double steps = std::max(1.0, std::ceil(piece.length_m / step_m));
    for (double k = series.x.empty() ? 0.0 : 1.0; k <= steps; k += 1.0) {
      const double s_m = piece.length_m * k / steps;
      series.x.push_back(piece.time_s + s_m / speed_mps);
      series.y.push_back(nearest_on_path(position_along(piece, s_m), path).distance_m);
    }
  }
  return series;
}

}  // namespace fairway
