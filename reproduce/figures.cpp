#include "reproduce/figures.hpp"

#include <array>
#include <utility>

#include <fmt/format.h>

#include "fairway/report/draw_chart.hpp"
#include "fairway/report/draw_flights.hpp"
#include "fairway/report/draw_plan.hpp"
#include "fairway/report/flight_series.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/simulate/start_states.hpp"
#include "fairway/vehicle/path_geometry.hpp"
#include "reproduce/world.hpp"

namespace fairway::reproduce {
namespace {

// The numbers of paper 1, section V.
constexpr double cell_of_figures_m = 8.0;
constexpr std::array<double, 3> sigmas{2.0, 4.0, 6.0};  // Figs. 6, 7
constexpr std::array<std::array<double, 2>, 3> cell_and_sigma{{{2, 16}, {4, 8}, {8, 4}}};  // Fig. 8

// Ours: how the curves are measured.
constexpr double window_s = 4.0;         // two radii of flight
constexpr double corner_reach_m = 60.0;  // three radii
constexpr double look_m = 0.5;
constexpr std::size_t random_starts = 2000;
constexpr std::uint64_t seed = 1;

/// A curve of a figure: its legend name, its cells and its sigma.
struct Curve {
  std::string name;
  double cell_m;
  double sigma_cells;
};

std::vector<Curve> curves_by_sigma() {
  std::vector<Curve> curves;
  for (const double sigma : sigmas)
    curves.push_back({fmt::format("σ = {}", sigma), cell_of_figures_m, sigma});
  return curves;
}

std::vector<Curve> curves_by_cell() {
  std::vector<Curve> curves;
  for (const auto& [cell_m, sigma] : cell_and_sigma)
    curves.push_back({fmt::format("res = {} m", cell_m), cell_m, sigma});
  return curves;
}

struct GoalCurves {
  Plan plan;  ///< of the figures' resolution, to draw upon
  std::vector<Flight> flights;
  std::vector<std::string> names;
  std::vector<GoalRow> rows;
};

GoalCurves fly_to_goal(const std::filesystem::path& scenario, const std::vector<Curve>& curves,
                       FieldOptions options) {
  GoalCurves out;
  const World coarse = world_of(scenario, cell_of_figures_m);
  out.plan = plan_in(coarse, options);
  // The same states for every curve: safe start on the coarsest grid.
  const std::vector<State> starts =
      random_states(out.plan, StartRegion::safe_start, random_starts, seed);
  for (const Curve& curve : curves) {
    const World world = world_of(scenario, curve.cell_m);
    options.sigma_cells = curve.sigma_cells;
    const ExactFlights flights(plan_in(world, options));
    const double v = world.vehicle.speed_mps;
    out.flights.push_back(flights.record(world.start));
    out.names.push_back(curve.name);
    GoalRow row{curve.name, curve.cell_m, curve.sigma_cells,
                heading_measures(out.flights.back(), v, window_s),
                out.flights.back().result.time_s};
    double reached = 0.0;
    for (const Flight& flight : flights.record_all(starts)) {
      if (flight.result.outcome != Outcome::reach) continue;
      const HeadingMeasures m = heading_measures(flight, v, window_s);
      reached += 1.0;
      row.mean_turning_rad += m.turning_rad;
      row.mean_reversals += m.reversals;
      row.mean_rms_rate_radps += m.rms_rate_radps;
      row.mean_largest_rate_radps += m.largest_rate_radps;
    }
    if (reached > 0.0)
      for (double* mean : {&row.mean_turning_rad, &row.mean_reversals, &row.mean_rms_rate_radps,
                           &row.mean_largest_rate_radps})
        *mean /= reached;
    row.reached_share = reached / static_cast<double>(starts.size());
    out.rows.push_back(std::move(row));
  }
  return out;
}

struct PathCurves {
  Plan plan;
  PathMission path;
  std::vector<Flight> laps;
  std::vector<std::string> names;
  std::vector<PathRow> rows;
};

/// The flight from `from_s` on, with its clock restarted.
Flight later_part(const Flight& flight, double from_s) {
  Flight part;
  part.result = flight.result;
  for (const FlightSegment& piece : flight.segments) {
    if (piece.time_s < from_s) continue;
    part.segments.push_back(piece);
    part.segments.back().time_s -= from_s;
  }
  if (!part.segments.empty()) part.start = part.segments.front().start;
  return part;
}

PathCurves fly_along_path(const std::filesystem::path& scenario, const std::vector<Curve>& curves,
                          FieldOptions options) {
  options.path_field = PathField::paper;  // what the paper's figures show
  PathCurves out;
  const World coarse = world_of(scenario, cell_of_figures_m);
  out.plan = plan_in(coarse, options);
  out.path = std::get<PathMission>(coarse.mission);
  const double lap_m = length_of(out.path);
  // From the first vertex, along the first edge: the paper's charts begin on the path.
  const Vec2 first = out.path.vertices_m[0];
  const State start{first, Heading::of(out.path.vertices_m[1] - first)};
  for (const Curve& curve : curves) {
    const World world = world_of(scenario, curve.cell_m);
    options.sigma_cells = curve.sigma_cells;
    const ExactFlights flights(plan_in(world, options));
    const double v = world.vehicle.speed_mps;
    out.laps.push_back(flights.follow(start, lap_m));
    out.names.push_back(curve.name);
    const Flight second = later_part(flights.follow(start, 2.0 * lap_m), lap_m / v);
    out.rows.push_back({curve.name, curve.cell_m, curve.sigma_cells,
                        path_measures(second, v, out.path, corner_reach_m, look_m)});
  }
  return out;
}

Picture heading_chart(const GoalCurves& curves, const std::string& title) {
  std::vector<ChartSeries> series;
  for (std::size_t i = 0; i < curves.flights.size(); ++i)
    series.push_back(
        heading_over_time(curves.flights[i], curves.plan.vehicle.speed_mps, curves.names[i]));
  return draw_chart(series, {.title = title, .x_label = "time (s)", .y_label = "θ (rad)"});
}

Picture distance_chart(const PathCurves& curves, const std::string& title) {
  std::vector<ChartSeries> series;
  for (std::size_t i = 0; i < curves.laps.size(); ++i)
    series.push_back(path_distance_over_time(curves.laps[i], curves.plan.vehicle.speed_mps,
                                             curves.path, 2.0, curves.names[i]));
  return draw_chart(series, {.title = title,
                             .x_label = "time (s)",
                             .y_label = "distance from path (m)",
                             .y_from_zero = true});
}

void draw_field_steps(const std::filesystem::path& scenario, FieldOptions options,
                      std::map<std::string, Picture>& pictures) {
  options.sigma_cells = 4.0;
  const World world = world_of(scenario, cell_of_figures_m);
  const FieldSteps steps = steps_in(world, options);
  PlanPictureOptions regions{.cost = false, .streamlines = false};
  PlanPictureOptions arrows{.cost = false, .streamlines = false, .arrows = true};
  arrows.arrows_across = 65;
  Plan before_goal = steps.complete_map;
  for (Region& region : before_goal.region)
    if (region == Region::goal) region = Region::free;
  const auto draw = [&](const char* name, const Plan& plan, PlanPictureOptions how,
                        const char* title) {
    how.title = title;
    if (how.arrows) how.mission = world.mission;
    pictures[name] = draw_plan(plan, how);
  };
  draw("fig3", before_goal, regions, "Fig. 3: buffer region");
  draw("fig4a", steps.complete_map, regions, "Fig. 4a: complete map");
  draw("fig4b", steps.raw, arrows, "Fig. 4b: raw vector field");
  draw("fig5a", steps.transitions, arrows, "Fig. 5a: field before smoothing");
  draw("fig5b", steps.smoothed, arrows, "Fig. 5b: smoothed field, σ = 4");
}

}  // namespace

FieldOptions options_to_the_letter() {
  FieldOptions options;
  options.metric = Metric::paper;
  options.filter = Filter::paper;
  options.blend = Blend::paper;
  options.alpha = options.beta = 2.0;
  options.mu_path = options.mu_border = 0.5;
  options.sigma_path = options.sigma_border = 1.5;
  return options;
}

Reproduction reproduce_figures(const std::filesystem::path& demo, const FieldOptions& base) {
  const auto goal_scenario = demo / "demo.toml";
  const auto path_scenario = demo / "path.toml";
  Reproduction out;
  auto& pictures = out.pictures;
  draw_field_steps(goal_scenario, base, pictures);

  GoalCurves goal = fly_to_goal(goal_scenario, curves_by_sigma(), base);
  const Mission goal_mission = world_of(goal_scenario, cell_of_figures_m).mission;
  pictures["fig6a"] = draw_flights(
      goal.plan, goal.flights,
      {.title = "Fig. 6a: single goal mission", .mission = goal_mission, .names = goal.names});
  pictures["fig6b"] = heading_chart(goal, "Fig. 6b: heading");
  out.goal_by_sigma = std::move(goal.rows);

  PathCurves path = fly_along_path(path_scenario, curves_by_sigma(), base);
  pictures["fig7a"] = draw_flights(
      path.plan, path.laps,
      {.title = "Fig. 7a: path following", .mission = Mission(path.path), .names = path.names});
  pictures["fig7b"] = distance_chart(path, "Fig. 7b: distance from path");
  out.path_by_sigma = std::move(path.rows);

  goal = fly_to_goal(goal_scenario, curves_by_cell(), base);
  pictures["fig8a"] = heading_chart(goal, "Fig. 8a: heading");
  out.goal_by_cell = std::move(goal.rows);
  path = fly_along_path(path_scenario, curves_by_cell(), base);
  pictures["fig8b"] = distance_chart(path, "Fig. 8b: distance from path");
  out.path_by_cell = std::move(path.rows);
  return out;
}

}  // namespace fairway::reproduce
