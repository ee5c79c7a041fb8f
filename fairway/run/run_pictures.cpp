#include "fairway/run/run_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "fairway/base/atomic_file.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/report/draw_chart.hpp"
#include "fairway/report/draw_flights.hpp"
#include "fairway/report/draw_plan.hpp"
#include "fairway/report/flight_series.hpp"
#include "fairway/report/tube_outline.hpp"
#include "fairway/vehicle/path_locator.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

void write(const Picture& picture, const std::filesystem::path& folder, const std::string& name) {
  write_whole(folder / (name + ".svg"), Existing::keep, picture.svg);
  write_whole(folder / (name + ".png"), Existing::keep, picture.png);
}

std::string name_of_start(const State& start) {
  return fmt::format("from ({}, {}, {:.2f} rad)", coordinate_text(start.position_m.x),
                     coordinate_text(start.position_m.y), start.heading.rad());
}

/// The cells of the plan that a window touches, and one more on each side.
Plan part_of(const Plan& plan, Vec2 low_m, Vec2 high_m) {
  const Grid& grid = plan.grid;
  const Cell low = grid.cell_of(low_m);
  const Cell high = grid.cell_of(high_m);
  const int x0 = std::clamp(low.ix - 1, 0, grid.nx - 1);
  const int y0 = std::clamp(low.iy - 1, 0, grid.ny - 1);
  const int x1 = std::clamp(high.ix + 1, x0, grid.nx - 1);
  const int y1 = std::clamp(high.iy + 1, y0, grid.ny - 1);
  Plan part;
  const Vec2 corner = grid.corner({x0, y0});
  part.grid = {x1 - x0 + 1, y1 - y0 + 1, corner.x, corner.y, grid.cell_m};
  part.vehicle = plan.vehicle;
  for (int iy = y0; iy <= y1; ++iy) {
    for (int ix = x0; ix <= x1; ++ix) {
      const std::size_t i = grid.index({ix, iy});
      part.heading_rad.push_back(plan.heading_rad[i]);
      part.region.push_back(plan.region[i]);
      part.cost_m.push_back(plan.cost_m[i]);
    }
  }
  return part;
}

/// A distance, over the time of all lines.
ChartSeries level_line(std::span<const ChartSeries> distances, std::string name, double level_m) {
  double end_s = 0.0;
  for (const ChartSeries& line : distances) {
    if (!line.x.empty()) end_s = std::max(end_s, line.x.back());
  }
  return {std::move(name), {0.0, end_s}, {level_m, level_m}, LineStyle::dashed};
}

/// How far from the mission's path whoever follows it may be: the tube is about a line that cuts
/// sharp corners.
double proved_distance_m(const FollowProof& proof, const PathMission& path, double step_m) {
  const PathLocator line(proof.path);
  const PathLocator given(path);
  double cut_m = 0.0;
  for (double at_m = 0.0; at_m < line.length_m(); at_m += step_m) {
    cut_m = std::max(cut_m, given.nearest(line.place(at_m)).distance_m);
  }
  return widest_m(proof) + cut_m + 0.5 * step_m;  // between two places it is no larger
}

/// The part of the map that the last legs need.
void write_final_legs(const Plan& plan, const Mission& mission, std::span<const Flight> flights,
                      const std::string& title, const fs::path& folder) {
  const auto* goal = std::get_if<GoalMission>(&mission);
  if (goal == nullptr || !goal->goal_heading_rad) return;
  const double room_m = 2.0 * plan.vehicle.turn_radius_m;
  Vec2 low = goal->goal_m;
  Vec2 high = low;
  for (const Flight& flight : flights) {
    for (const FlightSegment& piece : flight.final_leg.segments) {
      const double step_m = 0.25 * plan.vehicle.turn_radius_m;
      for (double at_m = 0.0; at_m < piece.length_m + step_m; at_m += step_m) {
        const Vec2 p = state_at(piece, std::min(at_m, piece.length_m)).position_m;
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
      }
    }
  }
  const Vec2 room{room_m, room_m};
  const Plan near = part_of(plan, low - room, high + room);
  write(draw_flights(near, flights, {.title = title, .mission = mission, .names = {}}), folder,
        "final_legs");
}

}  // namespace

void write_run_pictures(const Plan& plan, const Mission& mission, const ScenarioFlights& flown,
                        const FollowProof* follow, const std::string& title,
                        const std::filesystem::path& folder) {
  write(draw_plan(plan, {.title = title, .mission = mission}), folder, "plan");
  write(draw_flights(plan, flown.recorded,
                     {.title = title, .mission = mission, .follow = follow, .names = {}}),
        folder, "flights");
  write_final_legs(plan, mission, flown.recorded, title, folder);

  // Charts of many lines are unreadable: use those of the given states, else the first ones.
  constexpr std::size_t most_lines = 6;
  const std::size_t wanted = flown.given > 0 ? flown.given : 3;
  const std::size_t lines = std::min({wanted, most_lines, flown.recorded.size()});
  if (lines == 0) return;
  const auto* path = std::get_if<PathMission>(&mission);
  std::vector<ChartSeries> headings;
  std::vector<ChartSeries> distances;
  const double step_m = plan.grid.cell_m / 4.0;
  for (const Flight& flight : std::span(flown.recorded).first(lines)) {
    const std::string name = name_of_start(flight.start);
    const double speed_mps = plan.vehicle.speed_mps;
    headings.push_back(wrapped_degrees(heading_over_time(flight, speed_mps, name)));
    if (path != nullptr) {
      distances.push_back(path_distance_over_time(flight, speed_mps, *path, step_m, name));
    }
  }
  ChartOptions chart{.title = title,
                     .x_label = "time, s",
                     .y_label = "heading, degrees counter-clockwise from east"};
  write(draw_chart(headings, chart), folder, "headings");
  if (path == nullptr) return;
  const double delta_m = path->delta_position_m;  // up to where a flight counts as on the path
  std::vector<ChartSeries> levels{
      level_line(distances, fmt::format("delta_position_m, {:g} m", delta_m), delta_m)};
  if (follow != nullptr) {
    const double most_m = proved_distance_m(*follow, *path, step_m);
    levels.push_back(level_line(
        distances, fmt::format("proved once it follows: {:.1f} m", std::ceil(10.0 * most_m) / 10.0),
        most_m));
  }
  distances.insert(distances.end(), levels.begin(), levels.end());
  chart.y_label = "distance to the path, m";
  chart.y_from_zero = true;
  write(draw_chart(distances, chart), folder, "distance");
}

}  // namespace fairway
