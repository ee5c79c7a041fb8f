#include "fairway/run/start_warnings.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/number_text.hpp"
#include "fairway/map/degrees_from_frame.hpp"

namespace fairway {
namespace {

bool is_in_obstacle(const State& s, const Plan& plan) {
  const Cell cell = plan.grid.cell_of(s.position_m);
  return plan.grid.contains(cell) && plan.region[plan.grid.index(cell)] == Region::obstacle;
}

bool looks_like(Vec2 p, double a, double b) {
  constexpr double near_deg = 0.5;
  return std::abs(p.x - a) < near_deg && std::abs(p.y - b) < near_deg;
}

}  // namespace

std::vector<std::string> obstacle_warnings(std::span<const State> starts, const Plan& plan) {
  std::size_t count = 0;
  const State* first = nullptr;
  for (const State& s : starts) {
    if (!is_in_obstacle(s, plan)) continue;
    if (count++ == 0) first = &s;
  }
  if (count == 0) return {};
  return {fmt::format(
      "{} of the scenario's {} states {} in an obstacle, {} {}: {} collided before "
      "{} {}.",
      count, starts.size(), count == 1 ? "lies" : "lie", count == 1 ? "at" : "the first at",
      place_text(first->position_m), count == 1 ? "it has" : "they have",
      count == 1 ? "it" : "they", count == 1 ? "moves" : "move")};
}

std::vector<std::string> degree_warnings(std::span<const State> starts, const Grid& grid,
                                         const Frame& frame) {
  const LonLatOf degrees = lon_lat_of(frame, "the map's frame");
  if (!degrees) return {};
  const Vec2 middle_m{grid.x0_m + grid.width_m() / 2.0, grid.y0_m + grid.height_m() / 2.0};
  const LonLat here = degrees(middle_m);
  for (const State& s : starts) {
    if (!looks_like(s.position_m, here.latitude_deg, here.longitude_deg) &&
        !looks_like(s.position_m, here.longitude_deg, here.latitude_deg))
      continue;
    return {
        fmt::format("the start {} is in metres, but looks like the map's latitude and "
                    "longitude ({}, {}): states in degrees are given as LAT,LON,COURSE to "
                    "--state-deg, or to simulate.states_deg of a scenario.",
                    place_text(s.position_m), decimal_text(here.latitude_deg, 3),
                    decimal_text(here.longitude_deg, 3))};
  }
  return {};
}

std::vector<std::string> start_warnings(std::span<const State> starts, const Plan& plan) {
  std::vector<std::string> warnings = obstacle_warnings(starts, plan);
  for (std::string& warning : degree_warnings(starts, plan.grid, frame_in(plan.record)))
    warnings.push_back(std::move(warning));
  return warnings;
}

}  // namespace fairway
