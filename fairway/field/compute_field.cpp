#include "fairway/field/compute_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/field/buffer_border.hpp"
#include "fairway/field/complete_map.hpp"
#include "fairway/field/cost_to_go.hpp"
#include "fairway/field/fallback_field.hpp"
#include "fairway/field/follow_field.hpp"
#include "fairway/field/gaussian_filter.hpp"
#include "fairway/field/holding_circle.hpp"
#include "fairway/field/raw_field.hpp"
#include "fairway/field/stored_command.hpp"
#include "fairway/field/transition.hpp"

namespace fairway {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

void check(const ObstacleMap& map, const Vehicle& vehicle, const Mission& mission,
           const FieldOptions& options) {
  const Grid& g = map.grid;
  require(g.nx > 0 && g.ny > 0 && map.obstacle.size() == g.size(),
          "compute_field: expected a map with cells");
  require(
      std::isfinite(g.x0_m) && std::isfinite(g.y0_m) && g.cell_m > 0.0 && std::isfinite(g.cell_m),
      "compute_field: expected a grid of finite numbers, cell_m > 0");
  require(std::isfinite(vehicle.turn_radius_m) && vehicle.turn_radius_m > g.cell_m,
          "compute_field: expected turn_radius_m larger than the cell");
  require(std::isfinite(vehicle.speed_mps) && vehicle.speed_mps > 0.0,
          "compute_field: expected speed_mps > 0");
  const auto positive = [](double v) { return std::isfinite(v) && v > 0.0; };
  const auto not_negative = [](double v) { return std::isfinite(v) && v >= 0.0; };
  require(positive(options.alpha) && positive(options.beta),
          "compute_field: expected alpha and beta > 0");
  require(not_negative(options.sigma_cells) && not_negative(options.sigma_path) &&
              not_negative(options.sigma_border),
          "compute_field: expected every sigma >= 0");
  require(options.axis_capture_rad >= 0.0 && options.axis_capture_rad <= 0.1,
          "compute_field: expected 0 <= axis_capture_rad <= 0.1");
  require(positive(options.mu_path) && options.mu_path <= 1.0 && positive(options.mu_border) &&
              options.mu_border <= 1.0,
          "compute_field: expected 0 < mu <= 1");
  const auto finite = [](Vec2 p) { return std::isfinite(p.x) && std::isfinite(p.y); };
  if (const auto* goal = std::get_if<GoalMission>(&mission)) {
    require(finite(goal->goal_m), "compute_field: a finite goal");
  } else {
    const auto& path = std::get<PathMission>(mission);
    require(path.vertices_m.size() >= 2 &&
                std::all_of(path.vertices_m.begin(), path.vertices_m.end(), finite),
            "compute_field: a path of two or more finite vertices");
  }
}

void smooth(VectorField& field, const ObstacleMap& map, const FieldOptions& options) {
  if (options.sigma_cells == 0.0) return;
  if (options.filter == Filter::paper) {
    gaussian_filter(field, map.grid.nx, map.grid.ny, options.sigma_cells);
  } else {
    gaussian_filter_between_walls(field, map.obstacle, map.grid.nx, map.grid.ny,
                                  options.sigma_cells);
  }
}

// Directions become headings. Where the filter's mean nearly vanishes it has no direction: such a
// cell keeps the direction it had before the filter, and is counted.
void set_headings(Field& out, const VectorField& smoothed, const VectorField& before,
                  double capture_rad) {
  const auto rows = static_cast<std::size_t>(out.grid.ny);
  const auto columns = static_cast<std::size_t>(out.grid.nx);
  std::vector<std::size_t> vanished(rows, 0);
  std::vector<std::size_t> unreachable(rows, 0);
  for_rows(out.grid.ny, [&](int first, int last) {
    for (auto iy = static_cast<std::size_t>(first); iy < static_cast<std::size_t>(last); ++iy) {
      for (std::size_t i = iy * columns; i < (iy + 1) * columns; ++i) {
        out.heading_rad[i] = nan;
        if (out.region[i] == Region::free && !std::isfinite(out.cost_m[i])) ++unreachable[iy];
        if (out.region[i] == Region::obstacle || !std::isfinite(out.cost_m[i])) continue;
        float x = smoothed.x[i];
        float y = smoothed.y[i];
        if (has_vanished(x, y)) {
          ++vanished[iy];
          x = before.x[i];
          y = before.y[i];
        }
        out.heading_rad[i] = stored_command(x, y, capture_rad);
      }
    }
  });
  for (std::size_t iy = 0; iy < rows; ++iy) {
    out.vanished_cells += vanished[iy];
    out.unreachable_free_cells += unreachable[iy];
  }
}

bool goal_is_reached_from_elsewhere(const Field& field) {
  for (std::size_t i = 0; i < field.region.size(); ++i) {
    if (field.region[i] == Region::free && std::isfinite(field.cost_m[i])) return true;
  }
  return false;
}

}  // namespace

FieldOrRefusal compute_field(const ObstacleMap& map, const Vehicle& vehicle, const Mission& mission,
                             const FieldOptions& options) {
  check(map, vehicle, mission, options);
  const Grid& grid = map.grid;

  std::variant<CompleteMap, MissionRefusal> placed = complete_map(map, vehicle, mission, options);
  if (auto* refused = std::get_if<MissionRefusal>(&placed)) return std::move(*refused);
  auto& complete = std::get<CompleteMap>(placed);

  std::vector<float> cost = cost_to_go(grid, complete, mission, options.metric);
  BufferBorder border = buffer_border(grid, complete.region, cost);
  VectorField raw = raw_field(grid, complete, mission, options.metric, cost, border);
  const VectorField turned = transition_field(grid, complete, border, raw, vehicle, options);
  VectorField smoothed = turned;
  smooth(smoothed, map, options);
  const auto* path = std::get_if<PathMission>(&mission);
  if (path != nullptr && options.path_field == PathField::follow) {
    follow_field(grid, complete, *path, cost, vehicle, smoothed);
  }
  const auto* goal = std::get_if<GoalMission>(&mission);
  if (goal != nullptr && goal->hold) {
    // The way to the circle: that to the goal, but for the circle's radius.
    const HoldingPlace place = holding_place_at(grid, goal->goal_m, vehicle);
    std::vector<float> way = cost;
    for (float& w : way) w = std::fabs(w - static_cast<float>(place.radius_m / grid.cell_m));
    follow_circle(grid, complete.region, place, way, vehicle, smoothed);
  }

  Field out;
  out.grid = grid;
  out.region = std::move(complete.region);
  out.cost_m = std::move(cost);
  for (float& c : out.cost_m) c *= static_cast<float>(grid.cell_m);
  out.heading_rad.resize(grid.size());
  set_headings(out, smoothed, turned,
               options.metric == Metric::paper ? 0.0 : options.axis_capture_rad);
  if (!goal_is_reached_from_elsewhere(out)) {
    return MissionRefusal{MissionRefusal::Reason::unreachable,
                          "no safe-start cell outside the goal can reach it", 0.0, map.warnings};
  }
  if (options.fallback == FallbackRule::hold) {
    out.holding_places = add_fallback(vehicle, options, out);
  }
  return out;
}

}  // namespace fairway
