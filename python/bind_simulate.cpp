// simulate: flying, exact and sampled.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "bind_flights.hpp"
#include "binding.hpp"
#include "fairway/simulate/sampled_flight.hpp"
#include "fairway/simulate/start_states.hpp"

namespace fairway::python {
namespace {

using namespace pybind11::literals;

/// Without the interpreter's lock.
void fly_all(Flights& flights) {
  FlyOptions options;
  options.follow = flights.follow;
  options.measure = true;
  options.progress = [](std::size_t) { raise_on_signal(); };
  ManyFlights flown = fly_many(*flights.engine, flights.starts, options);
  flights.results = std::move(flown.results);
  flights.measures = std::move(flown.measures);
  flights.followed = flown.followed;
}

std::optional<FollowFor> follow_of(const HeldPlan& plan, std::optional<double> laps,
                                   std::optional<double> follow_s) {
  if (!laps && !follow_s) return {};
  if (laps && follow_s) throw py::value_error("laps, follow_s: expected only one of them");
  const double value = laps ? *laps : *follow_s;
  const char* name = laps ? "laps" : "follow_s";
  if (!(value > 0.0) || value > 1e9) {
    throw py::value_error(fmt::format("{}: is {}, expected above 0 and up to 1e9", name, value));
  }
  if (plan.exact().path() == nullptr) {
    throw py::value_error(fmt::format(
        "{}: the plan's mission is not a path, nor a goal to hold at, and only these are followed",
        name));
  }
  return FollowFor{.laps = laps.value_or(0.0), .time_s = follow_s.value_or(0.0)};
}

std::shared_ptr<Flights> fly(const std::shared_ptr<HeldPlan>& plan, const py::object& states,
                             std::optional<double> laps, std::optional<double> follow_s) {
  auto flown = std::make_shared<Flights>();
  flown->plan = plan;
  flown->starts = states_of(states, "states");
  flown->follow = follow_of(*plan, laps, follow_s);
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
                                     double gust_time_s, double time_limit_s, std::uint64_t seed,
                                     std::optional<double> laps, std::optional<double> follow_s) {
  auto flown = std::make_shared<Flights>();
  flown->plan = plan;
  flown->starts = states_of(states, "states");
  flown->follow = follow_of(*plan, laps, follow_s);
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

}  // namespace

void bind_simulate(py::module_& m) {
  std::vector<std::pair<const char*, int>> codes;
  for (const Outcome o : outcomes_in_order) {
    codes.emplace_back(name_of(o), static_cast<int>(o));
  }
  add_enum(m, "Outcome", "What ends a flight, as in Flights.outcome; numbered like Verdict.",
           codes);
  std::vector<std::pair<const char*, int>> after_codes{{"none", static_cast<int>(After::none)}};
  for (const After after : afters_in_order) {
    after_codes.emplace_back(name_of(after), static_cast<int>(after));
  }
  add_enum(m, "After", "What happened after reaching, for flights that were followed along a path.",
           after_codes);
  bind_flights(m);

  const SampledOptions d;
  auto plan = py::class_<HeldPlan, std::shared_ptr<HeldPlan>>(m.attr("Plan"));
  plan.def("fly", &fly, "states"_a, py::kw_only(), "laps"_a = py::none(), "follow_s"_a = py::none(),
           R"(Exact flights under the bang-bang law, event by event, without time steps.

states    float64 [n, 3]: x_m, y_m, heading_rad (-7 to 7)
laps      after reaching the path, or the goal to hold at, follow it for this many times its length
follow_s  the same, for this many seconds

Returns Flights. Runs on all cores without the GIL; Ctrl-C stops it.)");
  plan.def("fly_sampled", &fly_sampled, "states"_a, py::kw_only(), "law"_a = "bang-bang",
           "gain_per_s"_a = SaturatedProportional{}.gain_per_s,
           "control_period_s"_a = d.control_period_s, "position_noise_m"_a = d.position_noise_m,
           "heading_noise_rad"_a = d.heading_noise_rad, "wind_mps"_a = py::make_tuple(0.0, 0.0),
           "gust_mps"_a = d.gust_mps, "gust_time_s"_a = d.gust_time_s,
           "time_limit_s"_a = d.time_limit_s, "seed"_a = d.seed, "laps"_a = py::none(),
           "follow_s"_a = py::none(),
           R"(Flights as a real autopilot would fly the plan: sampled control, noise, wind, gusts.

states             float64 [n, 3]: x_m, y_m, heading_rad
law                "bang-bang"; "proportional", with gain_per_s; or a function of (x_m, y_m,
                   heading_rad, heading_error_rad, time_s), as measured, that returns the desired
                   turn rate in rad/s, positive to the left; clipped to the vehicle's limit
control_period_s   seconds between two control updates
position_noise_m   standard deviation of the measured position, each axis, metres
heading_noise_rad  standard deviation of the measured heading, radians
wind_mps           (east, north), metres per second: the direction it blows to
gust_mps           standard deviation of gusts, each axis, metres per second
gust_time_s        correlation time of gusts, seconds
time_limit_s       0: the time for 20 (nx + ny) cells or 4 times the cost to go
seed               random seed; flight i depends only on the plan, the options and i
laps, follow_s     as in fly; neither is part of time_limit_s

Returns Flights; trapped means: not ended within the time limit.)");
  plan.def("random_starts", &random_starts, "n"_a, "seed"_a = 1, py::kw_only(),
           "where"_a = "safe_start",
           R"(`n` random states, uniform over cells, places in them and headings: float64 [n, 3].

where  "safe_start": free cells from which the goal can be reached; "flyable": free and buffer
       cells; "not_obstacle": the same and goal cells

A longer list begins with a shorter one of the same seed.)");
}

}  // namespace fairway::python
