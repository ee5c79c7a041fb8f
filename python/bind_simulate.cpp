// simulate: flights, exact and sampled.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "binding.hpp"
#include "fairway/base/atomic_file.hpp"
#include "fairway/base/error.hpp"
#include "fairway/exchange/flight_files.hpp"
#include "fairway/exchange/qgc_mission.hpp"
#include "fairway/exchange/track.hpp"
#include "fairway/map/degrees_from_frame.hpp"
#include "fairway/report/draw_flights.hpp"
#include "fairway/run/flight_engine.hpp"
#include "fairway/run/fly_many.hpp"
#include "fairway/run/plan_map.hpp"
#include "fairway/run/plan_record.hpp"
#include "fairway/simulate/flight_statistics.hpp"
#include "fairway/simulate/sampled_flight.hpp"
#include "fairway/simulate/start_states.hpp"

namespace fairway::python {
namespace {

using namespace pybind11::literals;

constexpr const char* record_name = "the plan's record";

/// Many flights under one plan. They are flown again when their tracks are asked for: a flight
/// depends on its start and its index alone.
struct Flights {
  std::shared_ptr<HeldPlan> plan;
  std::shared_ptr<const FlightEngine> engine;  ///< of the plan
  std::vector<State> starts;
  std::vector<FlightResult> results;

  std::vector<Flight> recorded(std::size_t first, std::size_t count) const {
    const auto part = std::span(starts).subspan(first);
    FlyOptions options;
    options.tracks = std::min(count, part.size());
    options.first_index = first;
    return fly_many(*engine, part.first(options.tracks), options).recorded;
  }
};

struct Trajectory {
  FlightResult result;
  std::vector<FlightPoint> points;
};

/// One member of every item, as codes of the same size.
template <typename Code, typename Item, typename Member>
py::array column(const py::object& self, const std::vector<Item>& items, Member Item::*member) {
  static_assert(sizeof(Code) == sizeof(Member));
  static const Item none{};
  const Item& first = items.empty() ? none : items.front();
  return view(reinterpret_cast<const Code*>(&(first.*member)),
              {static_cast<py::ssize_t>(items.size())}, {static_cast<py::ssize_t>(sizeof(Item))},
              self);
}

/// Without the interpreter's lock.
void fly_all(Flights& flights) {
  FlyOptions options;
  options.progress = [](std::size_t) { raise_on_signal(); };
  flights.results = fly_many(*flights.engine, flights.starts, options).results;
}

std::shared_ptr<Flights> fly(const std::shared_ptr<HeldPlan>& plan, const py::object& states) {
  auto flown = std::make_shared<Flights>();
  flown->plan = plan;
  flown->starts = starts_of(states, "states");
  const py::gil_scoped_release unlocked;
  flown->engine = {plan, &plan->exact()};
  fly_all(*flown);
  return flown;
}

/// A law written in Python: called with the interpreter's lock, from the flying threads in turn.
CustomLaw custom_law(const py::function& law) {
  // The last copy may go in any thread: the function is let go with the lock taken.
  const std::shared_ptr<py::function> kept(new py::function(law), [](py::function* f) {
    const py::gil_scoped_acquire lock;
    delete f;
  });
  return [kept](const Measurement& seen) {
    const py::gil_scoped_acquire lock;
    return (*kept)(seen.state.position_m.x, seen.state.position_m.y, seen.state.heading.rad(),
                   seen.heading_error_rad, seen.time_s)
        .cast<double>();
  };
}

ControlLaw law_of(const py::object& law, double gain_per_s) {
  if (PyCallable_Check(law.ptr()) != 0) return custom_law(py::function(law));
  if (!py::isinstance<py::str>(law)) {
    throw py::type_error("law: expected \"bang-bang\", \"proportional\" or a function");
  }
  return choice_of("law", law.cast<std::string>(), sampled_laws(gain_per_s));
}

std::shared_ptr<Flights> fly_sampled(const std::shared_ptr<HeldPlan>& plan,
                                     const py::object& states, const py::object& law,
                                     double gain_per_s, double control_period_s,
                                     double position_noise_m, double heading_noise_rad,
                                     const py::object& wind_mps, double gust_mps,
                                     double gust_time_s, double time_limit_s, std::uint64_t seed) {
  auto flown = std::make_shared<Flights>();
  flown->plan = plan;
  flown->starts = starts_of(states, "states");
  SampledOptions options;
  options.law = law_of(law, gain_per_s);
  options.control_period_s = control_period_s;
  options.position_noise_m = position_noise_m;
  options.heading_noise_rad = heading_noise_rad;
  options.wind_mps = point_of(wind_mps, "wind_mps");
  options.gust_mps = gust_mps;
  options.gust_time_s = gust_time_s;
  options.time_limit_s = time_limit_s;
  options.seed = seed;
  const py::gil_scoped_release unlocked;
  flown->engine = std::make_shared<const FlightEngine>(plan->plan, options);
  fly_all(*flown);
  return flown;
}

py::array random_starts(const HeldPlan& plan, std::size_t n, std::uint64_t seed,
                        const std::string& where) {
  const auto region = choice_of<StartRegion>("where", where,
                                             {{"safe_start", StartRegion::safe_start},
                                              {"flyable", StartRegion::flyable},
                                              {"not_obstacle", StartRegion::not_obstacle}});
  std::vector<State> states;
  {
    const py::gil_scoped_release unlocked;
    states = random_states(plan.plan, region, n, seed);
  }
  if (n > 0 && states.empty()) {
    throw py::value_error("where: the plan has no cell to draw random starts from");
  }
  return state_array(std::move(states));
}

std::size_t place_in(const Flights& flights, py::ssize_t i) {
  const auto count = static_cast<py::ssize_t>(flights.starts.size());
  if (i < -count || i >= count) throw py::index_error(fmt::format("there are {} flights", count));
  return static_cast<std::size_t>(i < 0 ? i + count : i);
}

std::shared_ptr<Trajectory> trajectory(const Flights& flights, py::ssize_t i,
                                       std::optional<double> step_m) {
  const std::size_t place = place_in(flights, i);
  const Plan& plan = flights.plan->plan;
  const py::gil_scoped_release unlocked;
  const Flight flight = flights.recorded(place, 1).front();
  return std::make_shared<Trajectory>(Trajectory{
      flight.result, track_of(flight, plan.vehicle.speed_mps, step_m.value_or(plan.grid.cell_m))});
}

py::dict counts(const Flights& flights) {
  const OutcomeCounts all = count_outcomes(flights.results);
  py::dict by_name;
  for (const Outcome o : outcomes_in_order) {
    by_name[name_of(o)] = all.of(o);
  }
  return by_name;
}

Picture picture(const Flights& flights, const std::string& title, int most) {
  const py::gil_scoped_release unlocked;
  const auto drawn = flights.recorded(0, static_cast<std::size_t>(std::max(most, 0)));
  FlightPictureOptions options;
  options.title = title;
  options.mission = flights.plan->plan.record.mission;
  return draw_flights(flights.plan->plan, drawn, options);
}

enum class Text { outcomes, tracks, geojson };

void save(const Flights& flights, const std::filesystem::path& path, Text kind,
          std::optional<double> step_m, bool force) {
  const py::gil_scoped_release unlocked;
  const Existing existing = force ? Existing::replace : Existing::keep;
  require_writable_place(path, existing);
  const Plan& plan = flights.plan->plan;
  const double step = step_m.value_or(plan.grid.cell_m);
  std::string text;
  if (kind == Text::outcomes) {
    text = outcomes_csv(flights.starts, flights.results);
  } else {
    const std::vector<Flight> all = flights.recorded(0, flights.starts.size());
    text = kind == Text::tracks
               ? trajectories_csv(all, plan.vehicle.speed_mps, step)
               : flights_geojson(all, step, lon_lat_of(frame_in(plan.record), record_name));
  }
  write_whole(path, existing, text);
}

void save_mission(const Flights& flights, py::ssize_t i, const std::filesystem::path& path,
                  double altitude_m, double tolerance_m, bool force) {
  if (!is_qgc_mission_name(path)) {
    throw py::value_error("path: expected a name that ends in .plan, .waypoints or .txt");
  }
  const std::size_t place = place_in(flights, i);
  const py::gil_scoped_release unlocked;
  const Plan& plan = flights.plan->plan;
  const LonLatOf lon_lat = lon_lat_of(frame_in(plan.record), record_name);
  require(static_cast<bool>(lon_lat),
          "the plan's map is not georeferenced: there is no latitude and longitude to fly to");
  write_whole(path, force ? Existing::replace : Existing::keep,
              qgc_mission_text(path, flights.recorded(place, 1).front(), plan.vehicle.speed_mps,
                               lon_lat, {altitude_m, tolerance_m}));
}

void bind_trajectory(py::module_& m) {
  py::class_<Trajectory, std::shared_ptr<Trajectory>>(
      m, "Trajectory", "Points along one flight. Arrays are read-only views.")
      .def_property_readonly(
          "time_s",
          [](const py::object& self) {
            const auto& t = self.cast<const Trajectory&>();
            return column<double>(self, t.points, &FlightPoint::time_s);
          },
          "float64 [n]: seconds since the start.")
      .def_property_readonly(
          "state",
          [](const py::object& self) {
            const auto& t = self.cast<const Trajectory&>();
            return state_view(&t.points.data()->state, t.points.size(), sizeof(FlightPoint), self);
          },
          "float64 [n, 3]: x_m, y_m, heading_rad.")
      .def_property_readonly(
          "curvature_per_m",
          [](const py::object& self) {
            const auto& t = self.cast<const Trajectory&>();
            return column<double>(self, t.points, &FlightPoint::curvature_per_m);
          },
          "float64 [n]: 1/m, positive to the left, of the piece that begins at the point.")
      .def_property_readonly(
          "outcome", [](const Trajectory& t) { return name_of(t.result.outcome); },
          "\"reach\", \"collide\", \"leave\" or \"trapped\".")
      .def_property_readonly(
          "time_to_end_s", [](const Trajectory& t) { return t.result.time_s; },
          "Seconds to the end of the flight; +inf when trapped.")
      .def("__len__", [](const Trajectory& t) { return t.points.size(); })
      .def("__repr__", [](const Trajectory& t) {
        return fmt::format("<fairway.Trajectory: {} points, {} after {:g} s>", t.points.size(),
                           name_of(t.result.outcome), t.result.time_s);
      });
}

void bind_flights(py::module_& m) {
  py::class_<Flights, std::shared_ptr<Flights>>(
      m, "Flights",
      "What became of many flights; [i] belongs to start [i]. Arrays are read-only "
      "views. A simulation is evidence, never a verdict.")
      .def_property_readonly(
          "outcome",
          [](const py::object& self) {
            const auto& f = self.cast<const Flights&>();
            return column<std::int8_t>(self, f.results, &FlightResult::outcome);
          },
          "int8 [n]: codes of Outcome, the numbers that Verdict has for the same.")
      .def_property_readonly(
          "time_s",
          [](const py::object& self) {
            const auto& f = self.cast<const Flights&>();
            return column<double>(self, f.results, &FlightResult::time_s);
          },
          "float64 [n]: seconds to the event that ends the flight; +inf when trapped.")
      .def_property_readonly(
          "length_m",
          [](const py::object& self) {
            const auto& f = self.cast<const Flights&>();
            return column<double>(self, f.results, &FlightResult::length_m);
          },
          "float64 [n]: metres to the event that ends the flight; +inf when trapped.")
      .def_property_readonly(
          "start",
          [](const py::object& self) {
            const auto& f = self.cast<const Flights&>();
            return state_view(f.starts.data(), f.starts.size(), sizeof(State), self);
          },
          "float64 [n, 3]: x_m, y_m, heading_rad, the heading in (-pi, pi].")
      .def_property_readonly("counts", &counts, "How many flights ended how, a dict by name.")
      .def("trajectory", &trajectory, "i"_a, py::kw_only(), "step_m"_a = py::none(),
           "The track of flight `i`, with points at most `step_m` metres apart (default: a cell); "
           "where "
           "the goal has a heading, the last leg to it is in it.")
      .def("picture", &picture, py::kw_only(), "title"_a = "", "most"_a = 200,
           "The first `most` flights over the plan, a Picture.")
      .def(
          "save_outcomes",
          [](const Flights& f, const std::filesystem::path& path, bool force) {
            save(f, path, Text::outcomes, {}, force);
          },
          "path"_a, py::kw_only(), "force"_a = false,
          "CSV, a line per start: x_m,y_m,heading_rad,outcome,time_s,length_m.")
      .def(
          "save_csv",
          [](const Flights& f, const std::filesystem::path& path, std::optional<double> step_m,
             bool force) { save(f, path, Text::tracks, step_m, force); },
          "path"_a, py::kw_only(), "step_m"_a = py::none(), "force"_a = false,
          "The tracks as CSV (docs/formats.md), points at most `step_m` metres apart.")
      .def(
          "save_geojson",
          [](const Flights& f, const std::filesystem::path& path, std::optional<double> step_m,
             bool force) { save(f, path, Text::geojson, step_m, force); },
          "path"_a, py::kw_only(), "step_m"_a = py::none(), "force"_a = false,
          "The tracks as GeoJSON: longitude and latitude when the map is georeferenced, else "
          "metres and a note that says so.")
      .def("save_mission", &save_mission, "i"_a, "path"_a, py::kw_only(),
           "altitude_m"_a = QgcMissionOptions{}.altitude_m,
           "tolerance_m"_a = QgcMissionOptions{}.tolerance_m, "force"_a = false,
           "Flight `i` as a mission: .plan for QGroundControl, .waypoints or .txt for QGC WPL 110; "
           "`altitude_m` above its start, its line within `tolerance_m` of the flight, metres. "
           "ValueError when the plan's map is not georeferenced.")
      .def("_repr_png_", [](const Flights& f) { return py::bytes(picture(f, "", 200).png); })
      .def("__len__", [](const Flights& f) { return f.starts.size(); })
      .def("__repr__", [](const Flights& f) {
        const OutcomeCounts all = count_outcomes(f.results);
        return fmt::format("<fairway.Flights: {}, {} reach, {} collide, {} leave, {} are trapped>",
                           f.starts.size(), all.of(Outcome::reach), all.of(Outcome::collide),
                           all.of(Outcome::leave), all.of(Outcome::trapped));
      });
}

}  // namespace

void bind_simulate(py::module_& m) {
  std::vector<std::pair<const char*, int>> codes;
  for (const Outcome o : outcomes_in_order) {
    codes.emplace_back(name_of(o), static_cast<int>(o));
  }
  add_enum(m, "Outcome", "What ends a flight, as Flights.outcome has it; numbered as Verdict.",
           codes);
  bind_trajectory(m);
  bind_flights(m);

  const SampledOptions d;
  auto plan = py::class_<HeldPlan, std::shared_ptr<HeldPlan>>(m.attr("Plan"));
  plan.def("fly", &fly, "states"_a,
           R"(Exact flights under the bang-bang law, event by event, without time steps.

states  float64 [n, 3]: x_m, y_m, heading_rad (-7 to 7)

Returns Flights. On all cores; other threads of Python run meanwhile, and Ctrl-C ends it.)");
  plan.def("fly_sampled", &fly_sampled, "states"_a, py::kw_only(), "law"_a = "bang-bang",
           "gain_per_s"_a = SaturatedProportional{}.gain_per_s,
           "control_period_s"_a = d.control_period_s, "position_noise_m"_a = d.position_noise_m,
           "heading_noise_rad"_a = d.heading_noise_rad, "wind_mps"_a = py::make_tuple(0.0, 0.0),
           "gust_mps"_a = d.gust_mps, "gust_time_s"_a = d.gust_time_s,
           "time_limit_s"_a = d.time_limit_s, "seed"_a = d.seed,
           R"(Flights as a real autopilot would fly the plan: sampled control, noise, wind, gusts.

states             float64 [n, 3]: x_m, y_m, heading_rad
law                "bang-bang"; "proportional", with gain_per_s; or a function of (x_m, y_m,
                   heading_rad, heading_error_rad, time_s) as measured that returns the turn rate
                   wanted in rad/s, positive to the left; it is cut at the vehicle's limit
control_period_s   seconds between two controls
position_noise_m   standard deviation of the measured place, each axis, metres
heading_noise_rad  of the measured heading, radians
wind_mps           (east, north), metres per second, where it blows to
gust_mps           standard deviation of gusts, each axis, metres per second
gust_time_s        their correlation time, seconds
time_limit_s       0: the time for 20 (nx + ny) cells or 4 times the cost to go
seed               flight i depends on the plan, the options and i alone

Returns Flights; trapped means: not ended within the time limit.)");
  plan.def("random_starts", &random_starts, "n"_a, "seed"_a = 1, py::kw_only(),
           "where"_a = "safe_start",
           R"(`n` random states, uniform over cells, places in them and headings: float64 [n, 3].

where  "safe_start": free cells from which the goal can be reached; "flyable": free and buffer
       cells; "not_obstacle": the same and goal cells

A longer list begins with a shorter one of the same seed.)");
}

}  // namespace fairway::python
