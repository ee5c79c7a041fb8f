#include "fairway/report/flight_series.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
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

ChartSeries wrapped_degrees(const ChartSeries& headings) {
  constexpr double to_degrees = 180.0 / pi;
  ChartSeries series{headings.name, {}, {}, headings.style};
  const auto add = [&](double x, double y) {
    series.x.push_back(x);
    series.y.push_back(y);
  };
  // Turn k holds the headings in (180 (2 k - 1), 180 (2 k + 1)] degrees.
  const auto turn_of = [](double degrees) { return std::ceil((degrees - 180.0) / 360.0); };
  for (std::size_t i = 0; i < headings.x.size(); ++i) {
    const double y = to_degrees * headings.y[i];
    const double turn = turn_of(y);
    if (i > 0) {
      const double from_x = headings.x[i - 1];
      const double from_y = to_degrees * headings.y[i - 1];
      const double up = y > from_y ? 1.0 : -1.0;
      for (double k = turn_of(from_y); k != turn; k += up) {
        const double edge = 360.0 * k + 180.0 * up;  // where the line leaves turn k
        const double x = from_x + (headings.x[i] - from_x) * (edge - from_y) / (y - from_y);
        add(x, 180.0 * up);
        add(x, std::numeric_limits<double>::quiet_NaN());
        add(x, -180.0 * up);
      }
    }
    add(headings.x[i], y - 360.0 * turn);
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
