// simulate: the results of flights, their tracks, measures and files.
#include "bind_flights.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "fairway/base/atomic_file.hpp"
#include "fairway/base/error.hpp"
#include "fairway/exchange/flight_files.hpp"
#include "fairway/exchange/qgc_mission.hpp"
#include "fairway/exchange/track.hpp"
#include "fairway/map/degrees_from_frame.hpp"
#include "fairway/report/draw_flights.hpp"
#include "fairway/run/following_summary.hpp"
#include "fairway/run/plan_record.hpp"
#include "fairway/run/qgc_site.hpp"
#include "fairway/simulate/flight_statistics.hpp"

namespace fairway::python {
namespace {

using namespace pybind11::literals;

constexpr const char* record_name = "the plan's record";

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
    if (!is_listed(o, all.of(o))) continue;
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
    text = outcomes_csv(flights.starts, flights.results, flights.measures,
                        flights.followed.has_value(), plan.further_modes() > 0);
  } else {
    const std::vector<Flight> all = flights.recorded(0, flights.starts.size());
    text = kind == Text::tracks
               ? trajectories_csv(all, plan.vehicle.speed_mps, step, plan.further_modes() > 0)
               : flights_geojson(all, step, lon_lat_of(frame_in(plan.record), record_name));
  }
  write_whole(path, existing, text);
}

/// What is measured of all flights, as the command's --json has it.
py::object summary(const Flights& flights) {
  ManyFlights flown;
  flown.followed = flights.followed;
  flown.measures = flights.measures;
  const auto following = following_summary(flown, flights.results, flights.measures);
  return python_of({{"turning", turning_json(turning_summary(flights.results, flights.measures))},
                    {"following", following_json(following)}});
}

void warn(const std::string& warning) {
  if (PyErr_WarnEx(PyExc_UserWarning, warning.c_str(), 1) != 0) throw py::error_already_set();
}

void save_mission(const Flights& flights, py::ssize_t i, const std::filesystem::path& path,
                  double altitude_m, double tolerance_m,
                  const std::optional<std::filesystem::path>& fence, bool force) {
  if (!is_qgc_mission_name(path)) {
    throw py::value_error("path: expected a name that ends in .plan, .waypoints or .txt");
  }
  const bool keeps_site = path.extension() == ".plan";
  if (fence && !keeps_site) {
    throw py::value_error(
        "fence: needs a path that ends in .plan: other mission formats have no fence");
  }
  const std::size_t place = place_in(flights, i);
  std::vector<std::string> warnings;
  {
    const py::gil_scoped_release unlocked;
    const Plan& plan = flights.plan->plan;
    const LonLatOf lon_lat = lon_lat_of(frame_in(plan.record), record_name);
    require(static_cast<bool>(lon_lat),
            "the plan's map is not georeferenced, so waypoints have no latitude and longitude");
    std::optional<QgcSite> site;
    if (keeps_site) site = fence ? qgc_site_of(*fence) : qgc_site_of(plan.record, ".");
    const std::vector<Flight> flown = flights.recorded(place, 1);
    write_whole(path, force ? Existing::replace : Existing::keep,
                qgc_mission_text(path, flown.front(), plan.vehicle.speed_mps, lon_lat,
                                 {altitude_m, tolerance_m, site.value_or(QgcSite{})}));
    warnings = mission_warnings(flown);
    if (keeps_site && !site) warnings.push_back(no_fence_warning(plan.record, "fence=FILE"));
  }
  for (const std::string& warning : warnings) warn(warning);
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

using FlightsClass = py::class_<Flights, std::shared_ptr<Flights>>;

/// An array of one number that is measured of every flight.
template <typename Code, typename Part, typename Member>
void add_measure(FlightsClass& flights, const char* name, Part FlightMeasures::*part,
                 Member Part::*member, const char* doc) {
  static_assert(sizeof(Code) == sizeof(Member));
  flights.def_property_readonly(
      name,
      [part, member](const py::object& self) {
        const auto& measures = self.cast<const Flights&>().measures;
        static const FlightMeasures none{};
        const FlightMeasures& first = measures.empty() ? none : measures.front();
        return view(reinterpret_cast<const Code*>(&((first.*part).*member)),
                    {static_cast<py::ssize_t>(measures.size())},
                    {static_cast<py::ssize_t>(sizeof(FlightMeasures))}, self);
      },
      doc);
}

void add_measures(FlightsClass& flights) {
  using M = FlightMeasures;
  using P = PathFollowing;
  add_measure<double>(flights, "flown_m", &M::turning, &Turning::length_m,
                      "float64 [n]: metres flown over the ground; finite, also when trapped.");
  add_measure<std::uint64_t>(
      flights, "reversals", &M::turning, &Turning::reversals,
      "uint64 [n]: left turns after right ones or the other way round, in `flown_m`.");
  add_measure<double>(flights, "turned_rad", &M::turning, &Turning::turned_rad,
                      "float64 [n]: left and right turns added up, radians, in `flown_m`.");
  add_measure<std::int8_t>(
      flights, "after", &M::onward, &Onward::after,
      "int8 [n]: codes of After: what happened after reaching, for flights that were followed.");
  add_measure<double>(
      flights, "after_s", &M::onward, &Onward::time_s,
      "float64 [n]: seconds to where the flight was followed to, or ended; 0 for After.NONE.");
  add_measure<double>(
      flights, "joined_s", &M::following, &P::joined_s,
      "float64 [n]: seconds to when the flight is first on the path, within both deltas of the "
      "mission; +inf: never, or not followed. Distances and headings count from then on.");
  add_measure<double>(flights, "laps", &M::following, &P::laps,
                      "float64 [n]: progress along the path, by its length.");
  add_measure<double>(flights, "on_path_share", &M::following, &P::on_path_share,
                      "float64 [n]: share of the time within both deltas.");
  add_measure<double>(flights, "distance_mean_m", &M::following, &P::distance_mean_m,
                      "float64 [n]: metres from the path, the mean over time.");
  add_measure<double>(flights, "distance_worst_m", &M::following, &P::distance_worst_m,
                      "float64 [n]: metres from the path at worst.");
  add_measure<double>(flights, "heading_difference_worst_rad", &M::following, &P::heading_worst_rad,
                      "float64 [n]: largest difference from the path's direction, radians.");
}

void bind_all_flights(py::module_& m) {
  FlightsClass flights(
      m, "Flights",
      "The results of many flights; [i] belongs to start [i]. Arrays are read-only "
      "views. A simulation is evidence, never a verdict.");
  add_measures(flights);
  flights
      .def_property_readonly(
          "outcome",
          [](const py::object& self) {
            const auto& f = self.cast<const Flights&>();
            return column<std::int8_t>(self, f.results, &FlightResult::outcome);
          },
          "int8 [n]: codes of Outcome, which are the same numbers as in Verdict.")
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
      .def_property_readonly(
          "summary", &summary,
          "A dict of the measures: `turning` and, if followed, `following`; as in "
          "summary.json (docs/formats.md).")
      .def_property_readonly("counts", &counts, "Number of flights by outcome, a dict.")
      .def(
          "trajectory", &trajectory, "i"_a, py::kw_only(), "step_m"_a = py::none(),
          "The track of flight `i`, with points at most `step_m` metres apart (default: one cell), "
          "including the last leg if the goal has a heading.")
      .def("picture", &picture, py::kw_only(), "title"_a = "", "most"_a = 200,
           "A Picture of the first `most` flights over the plan.")
      .def(
          "save_outcomes",
          [](const Flights& f, const std::filesystem::path& path, bool force) {
            save(f, path, Text::outcomes, {}, force);
          },
          "path"_a, py::kw_only(), "force"_a = true,
          "CSV, a line per start: x_m,y_m,heading_rad,outcome,time_s,length_m and what is measured "
          "(docs/formats.md).")
      .def(
          "save_csv",
          [](const Flights& f, const std::filesystem::path& path, std::optional<double> step_m,
             bool force) { save(f, path, Text::tracks, step_m, force); },
          "path"_a, py::kw_only(), "step_m"_a = py::none(), "force"_a = true,
          "The tracks as CSV (docs/formats.md), points at most `step_m` metres apart.")
      .def(
          "save_geojson",
          [](const Flights& f, const std::filesystem::path& path, std::optional<double> step_m,
             bool force) { save(f, path, Text::geojson, step_m, force); },
          "path"_a, py::kw_only(), "step_m"_a = py::none(), "force"_a = true,
          "The tracks as GeoJSON: longitude and latitude if the map is georeferenced, else "
          "metres and a note that says so.")
      .def(
          "save_mission", &save_mission, "i"_a, "path"_a, py::kw_only(),
          "altitude_m"_a = QgcMissionOptions{}.altitude_m,
          "tolerance_m"_a = QgcMissionOptions{}.tolerance_m, "fence"_a = py::none(),
          "force"_a = true,
          "Flight `i` as a mission: .plan for QGroundControl, .waypoints or .txt for QGC WPL 110; "
          "`altitude_m` above its start, its line within `tolerance_m` of the flight, metres. "
          "`fence`: a .plan whose fence, rally points and home altitude the written .plan keeps "
          "(default: the one the map was read from). Warns if there is none, because uploading the "
          ".plan replaces the vehicle's, and if the flight does not end well. "
          "Raises ValueError if the plan's map is not georeferenced.")
      .def("_repr_png_", [](const Flights& f) { return py::bytes(picture(f, "", 200).png); })
      .def("__len__", [](const Flights& f) { return f.starts.size(); })
      .def("__repr__", [](const Flights& f) {
        const OutcomeCounts all = count_outcomes(f.results);
        std::size_t later = 0;
        for (const FlightMeasures& one : f.measures) {
          later += one.onward.after == After::collide ? 1 : 0;
        }
        return fmt::format(
            "<fairway.Flights: {}, {} reach{}, {} collide, {} leave the map, {} get trapped>",
            f.starts.size(), all.of(Outcome::reach),
            later > 0 ? fmt::format(" ({} of them collide later)", later) : "",
            all.of(Outcome::collide), all.of(Outcome::leave), all.of(Outcome::trapped));
      });
}

}  // namespace

void bind_flights(py::module_& m) {
  bind_trajectory(m);
  bind_all_flights(m);
}

}  // namespace fairway::python
