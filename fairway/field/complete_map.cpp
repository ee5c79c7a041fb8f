#include "fairway/field/complete_map.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/field/distance_transform.hpp"
#include "fairway/field/octile.hpp"

namespace fairway {
namespace {

using Reason = MissionRefusal::Reason;

// The largest squared distance, in cells, that is still buffer. The added 1e-9 keeps a distance of
// exactly alpha * r inside when the quotient is rounded down. Below the mark for "no obstacle".
double buffer_limit_cells2(const Grid& grid, const Vehicle& vehicle, const FieldOptions& options) {
  const double cells = options.alpha * vehicle.turn_radius_m / grid.cell_m;
  return std::min(cells * cells * (1.0 + 1e-9), no_feature_distance - 1.0);
}

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

// Algorithm 1, line 2. At least one sweep, and no more than the map can take: 0 would mean "until
// nothing changes".
int paper_sweeps(const Grid& grid, const Vehicle& vehicle, const FieldOptions& options) {
  const double width_cells = std::ceil(options.alpha * vehicle.turn_radius_m / grid.cell_m - 1e-9);
  return static_cast<int>(std::clamp(width_cells, 1.0, 1.0 * std::max(grid.nx, grid.ny)));
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
  const int sweeps = paper_sweeps(g, vehicle, options);
  const std::vector<float> number =
      paper_wavefront(not_obstacle, g.nx, g.ny, obstacles, 1.0F, sweeps);
  for (std::size_t i = 0; i < g.size(); ++i) {
    complete.region[i] = map.obstacle[i] != 0       ? Region::obstacle
                         : std::isfinite(number[i]) ? Region::buffer
                                                    : Region::free;
  }
}

MissionRefusal refusal(Reason reason, std::string message, double lacks_m = 0.0) {
  return {reason, std::move(message), lacks_m, {}};
}

// The cell centre nearest to the goal whose disc fits into the safe start, for the user's next try.
std::optional<Vec2> nearest_place_that_fits(const Grid& grid, const std::vector<Region>& region,
                                            Vec2 goal_m, double radius_m) {
  std::vector<std::uint8_t> taken(grid.size());
  for (std::size_t i = 0; i < taken.size(); ++i) taken[i] = region[i] != Region::free ? 1 : 0;
  std::vector<std::int32_t> d2(grid.size());
  distance_transform(taken, grid.nx, grid.ny, {d2, {}});
  // A little wider than the disc, so that the place still fits once its digits are printed.
  const double wide_m = radius_m + 1e-3 * grid.cell_m;
  const double wide_cells2 = (wide_m / grid.cell_m) * (wide_m / grid.cell_m);
  const auto fits = [&](std::size_t i, Vec2 p) {
    // A taken cell at (dx, dy) lies in the disc if (|dx| + 1/2)^2 + (|dy| + 1/2)^2 <= R^2; the
    // left side is d^2 + |dx| + |dy| + 1/2, and |dx| + |dy| is between d and sqrt(2) d.
    const double d = std::sqrt(static_cast<double>(d2[i]));
    if (d2[i] == 0 || d * d + std::numbers::sqrt2 * d + 0.5 <= wide_cells2) return false;
    if (d * d + d + 0.5 > wide_cells2) return true;
    const std::vector<std::uint32_t> cells = cells_inside_disc(grid, p, wide_m);
    return std::all_of(cells.begin(), cells.end(), [&](std::uint32_t c) { return taken[c] == 0; });
  };
  std::optional<Vec2> best;
  for (std::size_t i = 0; i < d2.size(); ++i) {
    const Vec2 p = grid.center(grid.cell_at(i));
    if (best && norm2(p - goal_m) >= norm2(*best - goal_m)) continue;
    if (fits(i, p)) best = p;
  }
  if (!best) return best;
  // As it will be printed, when it fits there, too.
  const Vec2 printed{std::round(100.0 * best->x) / 100.0, std::round(100.0 * best->y) / 100.0};
  const std::vector<std::uint32_t> cells = cells_inside_disc(grid, printed, wide_m);
  const bool fits_printed =
      !cells.empty() &&
      std::all_of(cells.begin(), cells.end(), [&](std::uint32_t c) { return taken[c] == 0; });
  return fits_printed ? printed : best;
}

// Distances to the nearest obstacle in the metric whose circles are squares, in cells: what
// Algorithm 1 widens obstacles by, since a sweep reaches all eight neighbours. Two passes are exact
// for it (Rosenfeld and Pfaltz 1968).
std::vector<int> square_distance_cells(const ObstacleMap& map) {
  const Grid& g = map.grid;
  std::vector<int> distance(g.size(), std::max(g.nx, g.ny));
  const auto lower = [&](Cell c, std::initializer_list<Cell> steps) {
    int& here = distance[g.index(c)];
    if (map.obstacle[g.index(c)] != 0) here = 0;
    for (const Cell step : steps) {
      const Cell n{c.ix + step.ix, c.iy + step.iy};
      if (g.contains(n)) here = std::min(here, distance[g.index(n)] + 1);
    }
  };
  for (int iy = 0; iy < g.ny; ++iy) {
    for (int ix = 0; ix < g.nx; ++ix) lower({ix, iy}, {{-1, 0}, {-1, -1}, {0, -1}, {1, -1}});
  }
  for (int iy = g.ny - 1; iy >= 0; --iy) {
    for (int ix = g.nx - 1; ix >= 0; --ix) lower({ix, iy}, {{1, 0}, {1, 1}, {0, 1}, {-1, 1}});
  }
  return distance;
}

// How far a mission that reaches into the buffer is from Assumption 1, by the buffer's own metric.
struct Shortage {
  std::size_t index = 0;     // the mission cell that comes closest to an obstacle
  double clearance_m = 0.0;  // what it has
  double lacks_m = 0.0;
  double largest_alpha = 0.0;  // that the clearance would do for: below, with the paper's up to it
  std::string needs;           // the demand in words
};
Shortage shortage_of(const CompleteMap& complete, const ObstacleMap& map, const Vehicle& vehicle,
                     const FieldOptions& options) {
  const double cell_m = map.grid.cell_m;
  const auto nearest = [&](const auto& distance) {
    return std::size_t{*std::min_element(
        complete.goal_cells.begin(), complete.goal_cells.end(),
        [&](std::uint32_t a, std::uint32_t b) { return distance[a] < distance[b]; })};
  };
  Shortage s;
  if (options.metric == Metric::paper) {
    const std::vector<int> distance = square_distance_cells(map);
    s.index = nearest(distance);
    s.clearance_m = distance[s.index] * cell_m;
    const double needed_m = (paper_sweeps(map.grid, vehicle, options) + 1) * cell_m;
    s.lacks_m = std::max(needed_m - s.clearance_m, 0.0);
    s.largest_alpha =  // rounded down, so that the printed digits do
        std::floor(1e4 * (s.clearance_m - cell_m) / vehicle.turn_radius_m) / 1e4;
    s.needs = fmt::format(
        "and must stay at least {:.6g} m away, a cell more than alpha * turn_radius_m in whole "
        "cells, both along x or y, whichever is more, as metric \"paper\" counts",
        needed_m);
    return s;
  }
  s.index = nearest(complete.clearance_cells2);
  s.clearance_m = std::sqrt(static_cast<double>(complete.clearance_cells2[s.index])) * cell_m;
  const double needed_m = options.alpha * vehicle.turn_radius_m;
  s.lacks_m = std::max(needed_m - s.clearance_m, 0.0);
  s.largest_alpha = s.clearance_m / vehicle.turn_radius_m;
  s.needs =
      fmt::format("and must stay farther than alpha * turn_radius_m = {:.6g} m away", needed_m);
  return s;
}

// "[x, y]", as a scenario has it.
std::string pair_text(Vec2 p) {
  return "[" + coordinate_text(p.x) + ", " + coordinate_text(p.y) + "]";
}

// The same of a place that must be met: in more digits where centimetres do not do.
std::string exact_pair_text(Vec2 p) {
  const auto text = [](double x) {
    return std::abs(std::round(100.0 * x) / 100.0 - x) < 1e-9 ? coordinate_text(x)
                                                              : fmt::format("{:.12g}", x);
  };
  return "[" + text(p.x) + ", " + text(p.y) + "]";
}

bool all_free(const CompleteMap& complete) {
  return std::all_of(complete.goal_cells.begin(), complete.goal_cells.end(),
                     [&](std::uint32_t i) { return complete.region[i] == Region::free; });
}

std::string lack_words(const Shortage& shortage) {
  return fmt::format("it lacks {:.6g} m{}", shortage.lacks_m,
                     shortage.lacks_m > 0.0 ? "" : " and a trifle, for as far is not farther");
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
  const auto next_try = [&]() -> std::string {
    const auto fits = nearest_place_that_fits(grid, complete.region, goal.goal_m, radius);
    if (std::find(map.obstacle.begin(), map.obstacle.end(), 0) == map.obstacle.end())
      return "no cell of this map is free, so that no alpha, beta or turn_radius_m would do";
    if (!fits)
      return "such a goal fits about no cell of this map: reduce alpha, beta or turn_radius_m";
    return "the nearest goal that fits is " + exact_pair_text(*fits);
  };
  if (complete.region[grid.index(cell)] == Region::obstacle) {
    return refusal(Reason::in_obstacle, fmt::format("the goal {} lies in an obstacle; {}",
                                                    pair_text(goal.goal_m), next_try()));
  }
  if (complete.goal_cells.empty()) {
    return refusal(Reason::goal_too_small,
                   fmt::format("no cell lies wholly inside the goal disc of radius beta * "
                               "turn_radius_m = {:.6g} m about {}: cells are {:.6g} m "
                               "wide; enlarge beta or reduce cell_m",
                               radius, pair_text(goal.goal_m), grid.cell_m));
  }
  if (all_free(complete)) return std::nullopt;
  const Shortage shortage = shortage_of(complete, map, vehicle, options);
  return refusal(Reason::in_buffer,
                 fmt::format("the goal disc (radius beta * turn_radius_m = {:.6g} m about {}"
                             ") reaches into the buffer: it comes within {:.6g} m of an "
                             "obstacle, {}, so {} (Assumption 1); {}",
                             radius, pair_text(goal.goal_m), shortage.clearance_m, shortage.needs,
                             lack_words(shortage), next_try()),
                 shortage.lacks_m);
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
  std::string next_try = fmt::format("alpha below {:.4g} would do", shortage.largest_alpha);
  if (options.metric == Metric::paper) {
    next_try = shortage.largest_alpha > 0.0
                   ? fmt::format("alpha up to {:.4f} would do", shortage.largest_alpha)
                   : "no alpha would do";
  }
  return refusal(Reason::in_buffer,
                 fmt::format("the path enters the buffer near {}: it comes within {:.6g} m "
                             "of an obstacle, {}, so {} (Assumption 1); {}",
                             pair_text(where), shortage.clearance_m, shortage.needs,
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
    mark_buffer_euclidean(complete, buffer_limit_cells2(grid, vehicle, options));
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
