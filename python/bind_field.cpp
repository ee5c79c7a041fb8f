// field: plans from arrays.
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include <pybind11/stl.h>

#include "binding.hpp"
#include "fairway/run/plan_map.hpp"

namespace fairway::python {
namespace {

using namespace pybind11::literals;

ObstacleMap map_of(const py::object& obstacles, std::optional<double> cell_m,
                   const py::object& origin_m) {
  if (py::isinstance<ObstacleMap>(obstacles)) {
    if (cell_m || !origin_m.is_none()) {
      throw py::value_error(
          "cell_m, origin_m: cannot be given with an ObstacleMap, which has its own");
    }
    return obstacles.cast<const ObstacleMap&>();
  }
  if (!cell_m) throw py::type_error("cell_m: is missing; expected the side of a cell in metres");
  return obstacles_of(obstacles, *cell_m,
                      origin_m.is_none() ? Vec2{} : point_of(origin_m, "origin_m"));
}

Mission mission_from(const py::object& goal_m, std::optional<double> goal_heading_rad,
                     const py::object& path_m, bool closed, double delta_position_m,
                     double delta_heading_rad) {
  if (goal_m.is_none() == path_m.is_none()) {
    throw py::value_error("expected either goal_m=(x, y) or path_m=[[x, y], ...]");
  }
  if (path_m.is_none()) return GoalMission{point_of(goal_m, "goal_m"), goal_heading_rad};
  if (goal_heading_rad) throw py::value_error("goal_heading_rad: belongs to goal_m, not to path_m");
  return PathMission{points_of(path_m, "path_m"), closed, delta_position_m, delta_heading_rad};
}

std::shared_ptr<HeldPlan> plan_arrays(
    const py::object& obstacles, std::optional<double> cell_m, const py::object& origin_m,
    double speed_mps, double turn_radius_m, const py::object& goal_m,
    std::optional<double> goal_heading_rad, const py::object& path_m, bool closed,
    double delta_position_m, double delta_heading_rad, double alpha, double beta,
    const std::string& metric, double sigma_cells, double mu_path, double sigma_path,
    double mu_border, double sigma_border, const std::string& filter, const std::string& blend,
    double axis_capture_rad, const std::string& path_field, const std::string& fallback) {
  const Mission mission =
      mission_from(goal_m, goal_heading_rad, path_m, closed, delta_position_m, delta_heading_rad);
  FieldOptions o;
  o.alpha = alpha;
  o.beta = beta;
  o.metric = choice_of<Metric>(
      "metric", metric,
      {{"euclidean", Metric::euclidean}, {"octile", Metric::octile}, {"paper", Metric::paper}});
  o.sigma_cells = sigma_cells;
  o.mu_path = mu_path;
  o.sigma_path = sigma_path;
  o.mu_border = mu_border;
  o.sigma_border = sigma_border;
  o.filter = choice_of<Filter>("filter", filter,
                               {{"free_space", Filter::free_space}, {"paper", Filter::paper}});
  o.blend = choice_of<Blend>("blend", blend,
                             {{"continuous", Blend::continuous}, {"paper", Blend::paper}});
  o.axis_capture_rad = axis_capture_rad;
  o.path_field = choice_of<PathField>("path_field", path_field,
                                      {{"follow", PathField::follow}, {"paper", PathField::paper}});
  o.fallback = choice_of<FallbackRule>(
      "fallback", fallback, {{"hold", FallbackRule::hold}, {"none", FallbackRule::none}});
  const ObstacleMap map = map_of(obstacles, cell_m, origin_m);

  const py::gil_scoped_release unlocked;
  auto answer = plan_map(map, {speed_mps, turn_radius_m}, mission, o);
  if (auto* refusal = std::get_if<MissionRefusal>(&answer)) {
    std::string message = refusal->message;
    throw Refused{std::move(*refusal), std::move(message)};
  }
  return std::make_shared<HeldPlan>(std::move(std::get<Plan>(answer)));
}

}  // namespace

void bind_field(py::module_& m) {
  const FieldOptions d;
  const PathMission path;
  m.def("plan_arrays", &plan_arrays, "obstacles"_a, "cell_m"_a = py::none(),
        "origin_m"_a = py::none(), py::kw_only(), "speed_mps"_a, "turn_radius_m"_a,
        "goal_m"_a = py::none(), "goal_heading_rad"_a = py::none(), "path_m"_a = py::none(),
        "closed"_a = path.closed, "delta_position_m"_a = path.delta_position_m,
        "delta_heading_rad"_a = path.delta_heading_rad, "alpha"_a = d.alpha, "beta"_a = d.beta,
        "metric"_a = "euclidean", "sigma_cells"_a = d.sigma_cells, "mu_path"_a = d.mu_path,
        "sigma_path"_a = d.sigma_path, "mu_border"_a = d.mu_border,
        "sigma_border"_a = d.sigma_border, "filter"_a = "free_space", "blend"_a = "continuous",
        "axis_capture_rad"_a = d.axis_capture_rad, "path_field"_a = "follow", "fallback"_a = "hold",
        R"(Computes the feedback plan for a map in memory.

obstacles         bool or uint8 (0 free, 1 obstacle), [ny, nx], the lowest row first (images have
                  their rows the other way round: use image[::-1]); or an ObstacleMap
cell_m            side of a cell, metres
origin_m          (x, y) of the lower left corner, metres; default (0, 0)
speed_mps         constant speed, metres per second
turn_radius_m     smallest turning radius, metres; more than cell_m
goal_m            (x, y) of the place to reach, metres; or
path_m            [n, 2], the path to follow, metres; closed=True joins its ends
goal_heading_rad  heading to arrive with, radians counter-clockwise from east

Beyond the array the vehicle has left the map; add a rim of obstacles to make that a collision.
The other keywords are the keys of a scenario's [plan] and [mission] tables (docs/scenario.md);
without alpha and sigma_cells the paper's are taken, 2 and 1, where a scenario has them chosen for
its map (docs/defaults.md).

Returns a Plan. Raises MissionRefused when the map does not allow the mission, ValueError when a
number is out of range, TypeError when an array has the wrong type. Other Python threads keep
running meanwhile.)");
}

}  // namespace fairway::python
