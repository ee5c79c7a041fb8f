#include "fairway/field/complete_map.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/field/buffer_rule.hpp"
#include "fairway/field/distance_transform.hpp"
#include "fairway/field/goal_advice.hpp"
#include "fairway/field/holding_circle.hpp"
#include "fairway/field/octile.hpp"

namespace fairway {
namespace {

using Reason = MissionRefusal::Reason;

void mark_buffer_euclidean(CompleteMap& complete, double limit_cells2) {
  for_ranges(complete.region.size(), 1 << 14, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const std::int32_t d2 = complete.clearance_cells2[i];
      complete.region[i] = d2 == 0              ? Region::obstacle
                           : d2 <= limit_cells2 ? Region::buffer
                                                : Region::free;
    }
  });
}

// Algorithm 1, lines 3 to 18.
void mark_buffer_paper(CompleteMap& complete, const ObstacleMap& map, const Vehicle& vehicle,
                       const FieldOptions& options) {
  const Grid& g = map.grid;
  std::vector<std::uint8_t> not_obstacle(g.size());
  std::vector<std::uint32_t> obstacles;
  for (std::size_t i = 0; i < g.size(); ++i) {
    not_obstacle[i] = map.obstacle[i] == 0 ? 1 : 0;
    if (map.obstacle[i] != 0) obstacles.push_back(static_cast<std::uint32_t>(i));
  }
  const int sweeps = paper_sweeps(g, options.alpha * vehicle.turn_radius_m);
  const std::vector<float> number =
      paper_wavefront(not_obstacle, g.nx, g.ny, obstacles, 1.0F, sweeps);
  for (std::size_t i = 0; i < g.size(); ++i) {
    complete.region[i] = map.obstacle[i] != 0       ? Region::obstacle
                         : std::isfinite(number[i]) ? Region::buffer
                                                    : Region::free;
  }
}

MissionRefusal refusal(Reason reason, std::string message, double lacks_m = 0.0) {
  return {reason, std::move(message), lacks_m, {}, {}};
}

// How far a mission that reaches into the buffer is from Assumption 1, by the buffer's own metric.
struct Shortage {
  std::size_t index = 0;     // the mission cell that comes closest to an obstacle
  double clearance_m = 0.0;  // what it has
  double lacks_m = 0.0;
  double largest_alpha = 0.0;  // alphas below it fit; with the paper's metric it fits, too
  std::string needs;           // the demand in words
};
Shortage shortage_of(const CompleteMap& complete, const ObstacleMap& map, const Vehicle& vehicle,
                     const FieldOptions& options) {
  const Clearances room = clearances(map, options.metric);
  const double width_m = options.alpha * vehicle.turn_radius_m;
  Shortage s;
  s.index = *std::min_element(
      complete.goal_cells.begin(), complete.goal_cells.end(),
      [&](std::uint32_t a, std::uint32_t b) { return room.measure[a] < room.measure[b]; });
  s.clearance_m = room.clearance_m(s.index);
  s.largest_alpha = room.free_width_m(s.index) / vehicle.turn_radius_m;
  if (options.metric == Metric::paper) {
    const double needed_m = (paper_sweeps(map.grid, width_m) + 1) * map.grid.cell_m;
    s.lacks_m = std::max(needed_m - s.clearance_m, 0.0);
    // Rounded down, so that the alpha printed fits.
    s.largest_alpha = std::floor(1e4 * s.largest_alpha) / 1e4;
    s.needs = fmt::format(
        "and must stay at least {} m away, one cell more than alpha * turn_radius_m in whole "
        "cells (metric \"paper\" takes the larger of the distances along x and y)",
        length_text(needed_m));
    return s;
  }
  s.lacks_m = std::max(width_m - s.clearance_m, 0.0);
  s.needs = fmt::format("and must stay farther than alpha * turn_radius_m = {} m away",
                        length_text(width_m));
  return s;
}

/// "[x, y]", as in a scenario.
std::string pair_text(Vec2 p) {
  constexpr int centimetres = 2;
  return metres_text(p, centimetres);
}

bool all_free(const CompleteMap& complete) {
  return std::all_of(complete.goal_cells.begin(), complete.goal_cells.end(),
                     [&](std::uint32_t i) { return complete.region[i] == Region::free; });
}

std::string lack_words(const Shortage& shortage) {
  return fmt::format(
      "it lacks {} m{}", length_text(shortage.lacks_m),
      shortage.lacks_m > 0.0 ? "" : " (the clearance equals the limit but must exceed it)");
}

/// `cause` has {} in place of the goal.
MissionRefusal with_advice(Reason reason, const GoalMission& goal, const std::string& cause,
                           double lacks_m, GoalAdvice advice) {
  MissionRefusal out;
  out.reason = reason;
  out.lacks_m = lacks_m;
  out.words = [goal_m = goal.goal_m, cause, advice](const PlaceText& place) {
    constexpr int centimetres = 2;
    return fmt::format(fmt::runtime(cause), place(goal_m, centimetres)) + "; " +
           words(advice, place);
  };
  out.message = out.words(metres_text);
  return out;
}

/// The circle must lie in the goal's cells, so that vehicles come to the goal, and in the disc
/// asked for; and nothing may lie where they overshoot it.
std::optional<MissionRefusal> refusal_of_hold(const CompleteMap& complete, const ObstacleMap& map,
                                              const GoalMission& goal, const Vehicle& vehicle,
                                              const FieldOptions& options) {
  const Grid& grid = map.grid;
  const HoldingPlace place = holding_place_at(grid, goal.goal_m, vehicle);
  const double room_m = holding_room_m(grid, vehicle);
  const double least_m = norm(place.center_m - goal.goal_m) + room_m;
  if (goal.hold_radius_m && *goal.hold_radius_m < least_m) {
    return refusal(
        Reason::goal_too_small,
        fmt::format("the vehicle cannot stay within hold_radius_m = {} m of the goal {}: "
                    "on cells of {} m it needs at least {} m",
                    length_text(*goal.hold_radius_m), pair_text(goal.goal_m),
                    length_text(grid.cell_m), length_text(least_m)));
  }
  const std::vector<PathCell> circle = cells_on_path(grid, path_of(place));
  const auto in_goal = std::count_if(circle.begin(), circle.end(), [&](const PathCell& cell) {
    return std::binary_search(complete.goal_cells.begin(), complete.goal_cells.end(), cell.index);
  });
  if (2 * static_cast<std::size_t>(in_goal) < circle.size()) {
    const double beta = (least_m + grid.cell_m) / vehicle.turn_radius_m;
    return refusal(
        Reason::goal_too_small,
        fmt::format("the goal disc of radius beta * turn_radius_m = {} m around {} has no "
                    "room for the circle of radius {} m on which the vehicle is to hold; "
                    "beta = {:.3g} would do, or smaller cells",
                    length_text(options.beta * vehicle.turn_radius_m), pair_text(goal.goal_m),
                    length_text(place.radius_m), beta));
  }
  const Shortage shortage = shortage_of(complete, map, vehicle, options);
  const double clear_m = shortage.clearance_m - grid.cell_m;
  const double beyond_m = least_m - options.beta * vehicle.turn_radius_m;
  if (clear_m >= beyond_m) return std::nullopt;
  return refusal(Reason::in_buffer,
                 fmt::format("the vehicle is to hold at the goal {}, and comes up to {} m from it, "
                             "too near an obstacle",
                             pair_text(goal.goal_m), length_text(least_m)),
                 beyond_m - clear_m);
}

std::optional<MissionRefusal> place_goal(CompleteMap& complete, const ObstacleMap& map,
                                         const GoalMission& goal, const Vehicle& vehicle,
                                         const FieldOptions& options) {
  const Grid& grid = map.grid;
  const double radius = options.beta * vehicle.turn_radius_m;
  if (!is_within(grid, goal.goal_m)) {
    return refusal(Reason::outside_map, "the goal " + outside_text(goal.goal_m, grid));
  }
  Cell cell = grid.cell_of(goal.goal_m);
  cell = {std::min(cell.ix, grid.nx - 1), std::min(cell.iy, grid.ny - 1)};
  complete.goal_cells = cells_inside_disc(grid, goal.goal_m, radius);
  if (complete.region[grid.index(cell)] == Region::obstacle) {
    return with_advice(Reason::in_obstacle, goal, "the goal {} lies in an obstacle", 0.0,
                       goal_advice(map, complete.region, goal.goal_m, vehicle, options));
  }
  if (complete.goal_cells.empty()) {
    return refusal(
        Reason::goal_too_small,
        fmt::format("no cell lies wholly inside the goal disc of radius beta * "
                    "turn_radius_m = {} m around {}: cells are {} m wide; enlarge beta "
                    "or reduce cell_m",
                    length_text(radius), pair_text(goal.goal_m), length_text(grid.cell_m)));
  }
  if (all_free(complete)) {
    return goal.hold ? refusal_of_hold(complete, map, goal, vehicle, options) : std::nullopt;
  }
  const Shortage shortage = shortage_of(complete, map, vehicle, options);
  return with_advice(
      Reason::in_buffer, goal,
      fmt::format("the goal disc (radius beta * turn_radius_m = {} m around {{}}) reaches into the "
                  "buffer: it comes within {} m of an obstacle, {}, so {}",
                  length_text(radius), length_text(shortage.clearance_m), shortage.needs,
                  lack_words(shortage)),
      shortage.lacks_m, goal_advice(map, complete.region, goal.goal_m, vehicle, options));
}

std::optional<MissionRefusal> place_path(CompleteMap& complete, const ObstacleMap& map,
                                         const PathMission& path, const Vehicle& vehicle,
                                         const FieldOptions& options) {
  const Grid& grid = map.grid;
  for (std::size_t k = 0; k < path.vertices_m.size(); ++k) {
    const Vec2 p = path.vertices_m[k];
    if (is_within(grid, p)) continue;
    return refusal(Reason::outside_map,
                   fmt::format("vertex {} of the path: {}", k + 1, outside_text(p, grid)));
  }
  complete.path_cells = cells_on_path(grid, path);
  require(!complete.path_cells.empty(), "a path has at least two distinct vertices");
  for (const PathCell& cell : complete.path_cells) complete.goal_cells.push_back(cell.index);
  if (all_free(complete)) return std::nullopt;
  const Shortage shortage = shortage_of(complete, map, vehicle, options);
  const Vec2 where = grid.center(grid.cell_at(shortage.index));
  if (shortage.clearance_m == 0.0) {
    return refusal(Reason::in_obstacle, "the path crosses an obstacle near " + pair_text(where));
  }
  std::string next_try = "no alpha fits";
  if (options.metric == Metric::paper && shortage.largest_alpha > 0.0) {
    next_try = fmt::format("alpha up to {:.4f} would fit", shortage.largest_alpha);
  } else if (shortage.largest_alpha > 0.0) {
    next_try = fmt::format("alpha below {:.4g} would fit", rounded_down(shortage.largest_alpha, 4));
  }
  return refusal(Reason::in_buffer,
                 fmt::format("the path enters the buffer near {}: it comes within {} m "
                             "of an obstacle, {}, so {}; {}",
                             pair_text(where), length_text(shortage.clearance_m), shortage.needs,
                             lack_words(shortage), next_try),
                 shortage.lacks_m);
}

}  // namespace

std::variant<CompleteMap, MissionRefusal> complete_map(const ObstacleMap& map,
                                                       const Vehicle& vehicle,
                                                       const Mission& mission,
                                                       const FieldOptions& options) {
  const Grid& grid = map.grid;
  CompleteMap complete;
  complete.region.resize(grid.size());
  complete.clearance_cells2.resize(grid.size());
  distance_transform(map.obstacle, grid.nx, grid.ny, {complete.clearance_cells2, {}});
  if (options.metric == Metric::paper) {
    mark_buffer_paper(complete, map, vehicle, options);
  } else {
    mark_buffer_euclidean(
        complete, buffer_limit(grid, options.metric, options.alpha * vehicle.turn_radius_m));
  }

  const auto* goal = std::get_if<GoalMission>(&mission);
  std::optional<MissionRefusal> refused =
      goal != nullptr ? place_goal(complete, map, *goal, vehicle, options)
                      : place_path(complete, map, std::get<PathMission>(mission), vehicle, options);
  if (refused) {
    refused->warnings = map.warnings;
    return *std::move(refused);
  }
  for (const std::uint32_t i : complete.goal_cells) complete.region[i] = Region::goal;  // line 20
  return complete;
}

}  // namespace fairway
