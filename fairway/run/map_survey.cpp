#include "fairway/run/map_survey.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include "fairway/base/number_text.hpp"
#include "fairway/field/buffer_rule.hpp"
#include "fairway/field/connected_parts.hpp"
#include "fairway/map/degrees_from_frame.hpp"
#include "fairway/map/earth_frame.hpp"
#include "fairway/report/draw_plan.hpp"

namespace fairway {
namespace {

using nlohmann::json;

/// The next of ..., 1, 2, 5, 10, 20, ... from `length_m` on.
double round_up(double length_m) {
  const double power = std::pow(10.0, std::floor(std::log10(length_m)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (length_m <= step * power * (1.0 + 1e-9))
      return std::stod(fmt::format("{:g}", step * power));
  }
  return std::stod(fmt::format("{:g}", 10.0 * power));
}

Grid without_ring(const Grid& g) {
  return {g.nx - 2, g.ny - 2, g.x0_m + g.cell_m, g.y0_m + g.cell_m, g.cell_m};
}

double share_of(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

constexpr std::size_t parts_listed = 5;

std::string parts_words(const MapSurvey& s) {
  if (s.part_cells.empty()) return "none";
  if (s.part_cells.size() == 1) return "one, all free cells";
  std::string words;
  for (std::size_t i = 0; i < std::min(s.part_cells.size(), parts_listed); ++i) {
    words += fmt::format("{}{}", i == 0 ? "" : ", ",
                         whole_percent_text(share_of(s.part_cells[i], s.free_cells)));
  }
  return fmt::format("{}: {}{} of the free cells", s.part_cells.size(), words,
                     s.part_cells.size() > parts_listed ? ", ..." : "");
}

std::string place_words(const MapSurvey& s, Vec2 place_m) {
  const LonLatOf degrees = lon_lat_of(s.map.frame, "the map");
  constexpr int a_metre = 5;
  return place_text(place_m) +
         (degrees ? ", in degrees " + lat_lon_text(degrees(place_m), a_metre) : std::string());
}

}  // namespace

std::string earth_words(const Frame& frame) {
  if (frame.geo) {
    return fmt::format("(0, 0) is latitude {} longitude {}; x east, y north",
                       decimal_text(frame.geo->latitude_deg, 7),
                       decimal_text(frame.geo->longitude_deg, 7));
  }
  return frame.projected_crs ? "in a projected system; goals and states may be in degrees"
                             : "not georeferenced: metres only";
}

double sensible_cell_m(MapRequest request, int across) {
  request.cell_m = 1e4;
  for (int readings = 0;; ++readings) {
    const Grid grid = read_map(request).grid;
    // The ring of obstacles is not part of the map.
    const int cells = std::max(grid.nx, grid.ny) - (request.outside_is_obstacle ? 2 : 0);
    const double next_m = round_up(std::max(cells, 1) * request.cell_m / across);
    constexpr int most_readings = 12;
    if (next_m >= request.cell_m || readings == most_readings) return next_m;
    request.cell_m = next_m;
  }
}

MapSurvey survey_map(const MapRequest& request, std::optional<double> turn_radius_m) {
  MapSurvey s;
  s.map = read_map(request);
  s.turn_radius_m = turn_radius_m;
  const Grid& grid = s.map.grid;
  s.inside = request.outside_is_obstacle ? without_ring(grid) : grid;
  const FieldOptions options;
  const Clearances room = clearances(s.map, options.metric);
  const double limit =
      turn_radius_m ? buffer_limit(grid, options.metric, options.alpha * *turn_radius_m) : 0.0;
  s.region.resize(grid.size());
  std::vector<std::uint8_t> free(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    free[i] = room.measure[i] > limit ? 1 : 0;
    s.region[i] = room.measure[i] == 0 ? Region::obstacle
                  : free[i] != 0       ? Region::free
                                       : Region::buffer;
    s.free_cells += free[i];
  }
  s.part_cells = connected_parts(free, grid.nx, grid.ny).cells;
  std::sort(s.part_cells.begin(), s.part_cells.end(), std::greater<>());
  const auto widest = std::max_element(room.measure.begin(), room.measure.end());
  if (*widest == 0) return s;
  const auto index = static_cast<std::size_t>(widest - room.measure.begin());
  s.clearance_m = room.clearance_m(index);
  s.widest_place_m = grid.center(grid.cell_at(index));
  return s;
}

std::string survey_words(const MapSurvey& s, const std::string& name) {
  const Grid& g = s.inside;
  std::string text = fmt::format("{}\n", name);
  const auto line = [&](const char* key, const std::string& words) {
    text += fmt::format("  {:<20}{}\n", key, words);
  };
  line("size", fmt::format("{} m x {} m: {} x {} cells of {} m", length_text(g.width_m()),
                           length_text(g.height_m()), g.nx, g.ny, length_text(g.cell_m)));
  line("frame", fmt::format("x from {} to {}, y from {} to {}", coordinate_text(g.x0_m),
                            coordinate_text(g.x0_m + g.width_m()), coordinate_text(g.y0_m),
                            coordinate_text(g.y0_m + g.height_m())));
  line("on Earth", earth_words(s.map.frame));
  const std::string of_radius =
      s.turn_radius_m ? fmt::format(" (outside the buffer of a turning radius of {} m)",
                                    length_text(*s.turn_radius_m))
                      : std::string();
  line("free", fmt::format("{} of the cells{}",
                           whole_percent_text(share_of(s.free_cells, g.size())), of_radius));
  line("connected parts", parts_words(s));
  if (s.widest_place_m) {
    const FieldOptions defaults;
    line("largest clearance", std::isinf(s.clearance_m)
                                  ? "unlimited: there are no obstacles"
                                  : fmt::format("{} m, at {}", length_text(s.clearance_m),
                                                place_words(s, *s.widest_place_m)));
    if (std::isfinite(s.clearance_m)) {
      line("", fmt::format("room for a goal and its buffer with a turning radius of up to about "
                           "{:.2g} m (alpha = beta = 2)",
                           s.clearance_m / (defaults.alpha + defaults.beta)));
    }
  }
  text.pop_back();
  return text;
}

json survey_json(const MapSurvey& s) {
  const Grid& g = s.inside;
  constexpr std::size_t most_parts = 100;
  const std::size_t told = std::min(s.part_cells.size(), most_parts);
  json all = {{"cells", {g.nx, g.ny}},
              {"cell_m", g.cell_m},
              {"origin_m", {g.x0_m, g.y0_m}},
              {"size_m", {g.width_m(), g.height_m()}},
              {"free_cells", s.free_cells},
              {"free_share", share_of(s.free_cells, g.size())},
              {"parts", s.part_cells.size()},
              {"part_cells", std::vector(s.part_cells.begin(),
                                         s.part_cells.begin() + static_cast<std::ptrdiff_t>(told))},
              {"largest_clearance_m", std::isfinite(s.clearance_m) ? json(s.clearance_m) : json()},
              {"widest_place_m", nullptr},
              {"widest_place_deg", nullptr},
              {"turn_radius_m", s.turn_radius_m ? json(*s.turn_radius_m) : json()},
              {"georeferenced", s.map.frame.is_on_earth()},
              {"reference_deg", nullptr},
              {"warnings", s.map.warnings}};
  if (const auto& geo = s.map.frame.geo) {
    all["reference_deg"] = {geo->latitude_deg, geo->longitude_deg};
  }
  if (s.widest_place_m) {
    all["widest_place_m"] = {s.widest_place_m->x, s.widest_place_m->y};
    if (const LonLatOf degrees = lon_lat_of(s.map.frame, "the map")) {
      const LonLat place = degrees(*s.widest_place_m);
      all["widest_place_deg"] = {place.latitude_deg, place.longitude_deg};
    }
  }
  return all;
}

Picture survey_picture(const MapSurvey& s, const std::string& title) {
  Plan plan;  // without a mission: all free cells look alike
  plan.grid = s.map.grid;
  plan.region = s.region;
  plan.cost_m.assign(plan.grid.size(), 0.0F);
  plan.heading_rad.assign(plan.grid.size(), std::numeric_limits<float>::quiet_NaN());
  PlanPictureOptions options;
  options.title = title;
  options.cost = false;
  options.streamlines = false;
  return draw_plan(plan, options);
}

}  // namespace fairway
