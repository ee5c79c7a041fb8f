// steer: obstacle-free steering to a pose.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "binding.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/steer/clf_law.hpp"
#include "fairway/steer/dubins_words.hpp"
#include "fairway/steer/shortest_law.hpp"
#include "fairway/steer/steering_flight.hpp"
#include "fairway/steer/waypoint_law.hpp"

namespace fairway::python {
namespace {

using namespace pybind11::literals;

py::array row(const State& state) {
  const double x[3] = {state.position_m.x, state.position_m.y, state.heading.rad()};
  return py::array_t<double>(3, x);
}

/// Many against many, or many against one.
void match(std::vector<State>& from, std::vector<State>& to) {
  if (from.size() == to.size()) return;
  if (from.size() == 1) {
    from.assign(to.size(), from.front());
  } else if (to.size() == 1) {
    to.assign(from.size(), to.front());
  } else {
    throw py::value_error(fmt::format(
        "start, goal: have {} and {} rows, expected equal numbers, or one row in either",
        from.size(), to.size()));
  }
}

py::tuple steer(const py::object& start, const py::object& goal, double turn_radius_m) {
  std::vector<State> from = states_of(start, "start");
  std::vector<State> to = states_of(goal, "goal");
  match(from, to);
  std::vector<double> length_m(from.size());
  std::vector<State> end(from.size());
  // Three letters of numpy's UCS-4 text each.
  std::vector<std::uint32_t> letters(3 * from.size());
  {
    const py::gil_scoped_release unlocked;
    std::vector<DubinsPath> paths(from.size());
    shortest_paths(from, to, turn_radius_m, paths);
    for_ranges(paths.size(), 1024, [&](std::size_t begin, std::size_t last) {
      for (std::size_t i = begin; i < last; ++i) {
        length_m[i] = paths[i].length_m();
        end[i] = end_of(paths[i]);
        const char* word = name_of(paths[i].word);
        for (std::size_t k = 0; k < 3; ++k) {
          letters[3 * i + k] = static_cast<std::uint32_t>(word[k]);
        }
      }
    });
  }
  const auto count = static_cast<py::ssize_t>(from.size());
  const py::array words(py::dtype("<U3"), std::vector<py::ssize_t>{count},
                        letters.empty() ? nullptr : letters.data());
  return py::make_tuple(owning(std::move(length_m)), words, state_array(std::move(end)));
}

void bind_path(py::module_& m) {
  py::class_<DubinsPath>(m, "DubinsPath",
                         "A turn, a straight line or a turn the other way, a turn.")
      .def_property_readonly("length_m", &DubinsPath::length_m, "Metres.")
      .def_property_readonly(
          "word", [](const DubinsPath& p) { return name_of(p.word); },
          "\"LSL\" and so on: left, straight, right.")
      .def_property_readonly(
          "part_m",
          [](const DubinsPath& p) { return py::make_tuple(p.part_m[0], p.part_m[1], p.part_m[2]); },
          "Lengths of the three parts, metres.")
      .def_property_readonly(
          "turn_radius_m", [](const DubinsPath& p) { return p.turn_radius_m; }, "Metres.")
      .def_property_readonly(
          "start", [](const DubinsPath& p) { return row(p.start); }, "[3]: x_m, y_m, heading_rad.")
      .def_property_readonly(
          "end", [](const DubinsPath& p) { return row(end_of(p)); }, "[3]: x_m, y_m, heading_rad.")
      .def(
          "pose_at", [](const DubinsPath& p, double length_m) { return row(pose_at(p, length_m)); },
          "length_m"_a, "[3]: the pose after `length_m` metres; beyond the end, the end.")
      .def(
          "sample",
          [](const DubinsPath& p, double step_m) {
            if (!(step_m > 0.0)) throw py::value_error("step_m: expected a number > 0");
            return state_array(sampled(p, step_m));
          },
          "step_m"_a, "float64 [n, 3]: poses at most `step_m` metres apart, including both ends.")
      .def("__repr__", [](const DubinsPath& p) {
        return fmt::format("<fairway.DubinsPath: {}, {:g} m>", name_of(p.word), p.length_m());
      });
}

/// `fly` for a law: the same arguments for both.
template <typename Law>
SteeringFlight flown(Law law, const py::object& start, const py::object& goal, double turn_radius_m,
                     std::optional<double> step_m, std::optional<double> tolerance_m,
                     double goal_speed, double noise_m, std::uint64_t seed) {
  if (!(goal_speed >= 0.0 && goal_speed < 1.0)) {
    throw py::value_error("goal_speed: expected a number from 0 to less than 1");
  }
  if (!(noise_m >= 0.0)) throw py::value_error("noise_m: expected a number of at least 0");
  const State from = state_of(start, "start");
  const State to = state_of(goal, "goal");
  const py::gil_scoped_release unlocked;
  SteeringOptions options = steering_options(from, to, turn_radius_m);
  if (step_m) options.step_m = *step_m;
  if (tolerance_m) options.tolerance = {*tolerance_m, *tolerance_m / turn_radius_m};
  options.length_limit_m /= 1.0 - goal_speed;
  const SteeringWorld world = world_of({goal_speed, noise_m, Random(seed)}, to, turn_radius_m);
  return fly(law, from, to, turn_radius_m, options, Track::all, world);
}

template <typename Law>
void define_law(py::class_<Law>& law) {
  law.def(
         "curvature_per_m",
         [](Law& self, const py::object& state, const py::object& goal, double turn_radius_m,
            double step_m) {
           return self.curvature_per_m(state_of(state, "state"), state_of(goal, "goal"),
                                       turn_radius_m, step_m);
         },
         "state"_a, "goal"_a, "turn_radius_m"_a, "step_m"_a,
         "The curvature (1/m, positive to the left, at most 1/turn_radius_m) to hold for the next "
         "`step_m` metres. state, goal: x_m, y_m, heading_rad.")
      .def("fly", &flown<Law>, "start"_a, "goal"_a, "turn_radius_m"_a, py::kw_only(),
           "step_m"_a = py::none(), "tolerance_m"_a = py::none(), "goal_speed"_a = 0.0,
           "noise_m"_a = 0.0, "seed"_a = 1,
           "Drives from `start` to `goal` under (a copy of) this law, in steps of `step_m` metres "
           "(default: a hundredth of the radius), until it is within `tolerance_m` and "
           "`tolerance_m` / radius radians (default: a fiftieth of the radius). The goal moves "
           "along its heading at `goal_speed` times the vehicle's speed; after each step x and y "
           "are off by `noise_m` (standard deviation) and the heading by `noise_m` / radius. "
           "Returns a SteeringFlight.");
}

void bind_laws(py::module_& m) {
  py::class_<SteeringFlight>(m, "SteeringFlight", "What a steering law drove.")
      .def_readonly("converged", &SteeringFlight::converged,
                    "Whether it ended within the tolerance of the goal.")
      .def_readonly("length_m", &SteeringFlight::length_m, "Metres driven.")
      .def_readonly("word", &SteeringFlight::word, "L, S, R as driven.")
      .def_property_readonly(
          "end", [](const SteeringFlight& f) { return row(f.end); }, "[3]: x_m, y_m, heading_rad.")
      .def_property_readonly(
          "track",
          [](const py::object& self) {
            const auto& f = self.cast<const SteeringFlight&>();
            return state_view(f.track.data(), f.track.size(), sizeof(State), self);
          },
          "float64 [n, 3]: one state a step, a read-only view.")
      .def("__repr__", [](const SteeringFlight& f) {
        return fmt::format("<fairway.SteeringFlight: {}, {:g} m, {}>", f.word, f.length_m,
                           f.converged ? "converged" : "not converged");
      });

  py::class_<ShortestLaw> shortest(m, "ShortestLaw",
                                   "Feedback that takes the shortest path (docs/steering.md). It "
                                   "remembers the path it follows: one for each vehicle.");
  shortest.def(py::init([](double place_m, double heading_rad, double tie_m) {
                 return ShortestLaw({{place_m, heading_rad}, tie_m});
               }),
               "place_m"_a, "heading_rad"_a, "tie_m"_a = ShortestLawOptions{}.tie_m,
               "A path that ends within `place_m` metres and `heading_rad` radians of the goal is "
               "kept, and so is a word at most `tie_m` metres longer than the shortest.");
  define_law(shortest);

  py::class_<ClfLaw> clf(m, "ClfLaw",
                         "The control law of Yong and Barth (paper 3, docs/steering.md). It "
                         "remembers one bit: one for each vehicle.");
  clf.def(
      py::init([](int n, const std::string& repulsion) {
        if (n < 1) throw py::value_error("n: expected at least 1");
        return ClfLaw({n, choice_of<Repulsion>("repulsion", repulsion,
                                               {{"none", Repulsion::none},
                                                {"overlap", Repulsion::overlap},
                                                {"overlap_behind", Repulsion::overlap_behind}})});
      }),
      "n"_a = ClfOptions{}.n, "repulsion"_a = "overlap_behind",
      "`n`: exponent of the vote (Eq. 8); `repulsion`: \"none\", \"overlap\" or "
      "\"overlap_behind\".");
  define_law(clf);
}

WaypointFlight follow(const py::object& start, const py::object& waypoints, double turn_radius_m,
                      const std::string& law, std::optional<double> place_m, double heading_rad,
                      double passed_place_m, double passed_heading_rad, double tie_m,
                      std::optional<double> step_m) {
  const State from = state_of(start, "start");
  const std::vector<State> way = states_of(waypoints, "waypoints");
  if (way.empty()) throw py::value_error("waypoints: expected at least one");
  const bool shortest = choice_of<bool>("law", law, {{"shortest", true}, {"clf", false}});
  const SteeringOptions usual = steering_options(from, way.front(), turn_radius_m);
  const WaypointOptions options{{place_m.value_or(usual.tolerance.place_m), heading_rad},
                                {passed_place_m, passed_heading_rad}};
  const double step = step_m.value_or(usual.step_m);
  const py::gil_scoped_release unlocked;
  if (shortest) {
    return follow_waypoints(shortest_waypoint_law(options, tie_m), from, way, turn_radius_m, step,
                            Track::all);
  }
  return follow_waypoints(WaypointLaw<ClfLaw>(ClfLaw(), options), from, way, turn_radius_m, step,
                          Track::all);
}

void bind_waypoints(py::module_& m) {
  py::class_<WaypointLeg>(m, "WaypointLeg", "The way to one waypoint.")
      .def_readonly("length_m", &WaypointLeg::length_m, "Metres driven.")
      .def_readonly("shortest_m", &WaypointLeg::shortest_m,
                    "Length of the shortest path from the start of the leg, metres.")
      .def_readonly("reached", &WaypointLeg::reached, "Otherwise passed, or given up.")
      .def_readonly("converged", &WaypointLeg::converged, "Reached or passed.")
      .def_readonly("word", &WaypointLeg::word, "L, S, R as driven.")
      .def_property_readonly(
          "end", [](const WaypointLeg& leg) { return row(leg.end); }, "[3]: x_m, y_m, heading_rad.")
      .def_property_readonly(
          "track",
          [](const py::object& self) {
            const auto& leg = self.cast<const WaypointLeg&>();
            return state_view(leg.track.data(), leg.track.size(), sizeof(State), self);
          },
          "float64 [n, 3]: one state a step, a read-only view.")
      .def("__repr__", [](const WaypointLeg& leg) {
        return fmt::format("<fairway.WaypointLeg: {}, {:g} m, {}>", leg.word, leg.length_m,
                           leg.reached     ? "reached"
                           : leg.converged ? "passed"
                                           : "given up");
      });
  py::class_<WaypointFlight>(m, "WaypointFlight", "What a law drove along waypoints.")
      .def_readonly("converged", &WaypointFlight::converged,
                    "Whether every waypoint was reached or passed.")
      .def_readonly("length_m", &WaypointFlight::length_m, "Metres driven.")
      .def_readonly("legs", &WaypointFlight::legs,
                    "A WaypointLeg for each waypoint, up to the first that is given up.")
      .def("__repr__", [](const WaypointFlight& f) {
        return fmt::format("<fairway.WaypointFlight: {} legs, {:g} m, {}>", f.legs.size(),
                           f.length_m, f.converged ? "converged" : "not converged");
      });
  m.def("follow_waypoints", &follow, "start"_a, "waypoints"_a, "turn_radius_m"_a, py::kw_only(),
        "law"_a = "shortest", "place_m"_a = py::none(),
        "heading_rad"_a = steering_options({}, {}, 1.0).tolerance.heading_rad,
        "passed_place_m"_a = 0.0, "passed_heading_rad"_a = 0.0,
        "tie_m"_a = ShortestLawOptions{}.tie_m, "step_m"_a = py::none(),
        R"(Drives along waypoints with headings, one after another, ignoring obstacles.

start               x_m, y_m, heading_rad
waypoints           float64 [n, 3]: x_m, y_m, heading_rad
law                 "shortest" or "clf"
place_m, heading_rad                a waypoint is reached within these; default: a fiftieth of the
                                    radius
passed_place_m, passed_heading_rad  and passed when the line across it is crossed within these
tie_m               "shortest": a word is kept while it is at most this much longer
step_m              metres between two control updates; default: a hundredth of the radius

Returns a WaypointFlight.)");
}

}  // namespace

void bind_steer(py::module_& m) {
  bind_path(m);
  bind_laws(m);
  bind_waypoints(m);
  m.def("steer", &steer, "start"_a, "goal"_a, "turn_radius_m"_a,
        R"(Shortest paths between many pairs of poses, on all cores.

start, goal    float64 [n, 3]: x_m, y_m, heading_rad; one of them may have a single row
turn_radius_m  smallest turning radius, metres

Returns (length_m float64 [n], word <U3 [n] such as "LSL", end float64 [n, 3]).)");
  m.def(
      "shortest_path",
      [](const py::object& start, const py::object& goal, double turn_radius_m) {
        return shortest_path(state_of(start, "start"), state_of(goal, "goal"), turn_radius_m);
      },
      "start"_a, "goal"_a, "turn_radius_m"_a,
      "The shortest path between two poses (x_m, y_m, heading_rad), a DubinsPath.");
}

}  // namespace fairway::python
