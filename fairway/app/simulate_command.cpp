// fairway simulate: flights under a plan file, exact or by a sampled control law.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "fairway/app/argument_checks.hpp"
#include "fairway/app/command.hpp"
#include "fairway/app/places.hpp"
#include "fairway/app/terminal_progress.hpp"
#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/exchange/flight_files.hpp"
#include "fairway/exchange/qgc_mission.hpp"
#include "fairway/map/degrees_from_frame.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/run/final_legs.hpp"
#include "fairway/run/plan_record.hpp"
#include "fairway/run/summary.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/simulate/sampled_flight.hpp"
#include "fairway/simulate/start_states.hpp"
#include "fairway/simulate/state_files.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct SimulateArguments {
  fs::path plan;
  std::vector<std::string> states;
  fs::path states_file;
  std::uint64_t random = 0;
  std::string random_in = "safe_start";
  fs::path csv;
  fs::path outcomes;
  fs::path geojson;
  fs::path qgc;
  QgcMissionOptions mission;
  double step_m = 0.0;        // 0: a cell
  std::string law = "exact";  // or "bang-bang", "proportional"
  double gain_per_s = SaturatedProportional{}.gain_per_s;
  SampledOptions sampled;
  std::string heading_noise;
  std::vector<double> wind_mps;
  bool sampled_only_given = false;
};

std::vector<State> starts_of(const SimulateArguments& arguments, const Plan& plan) {
  std::vector<State> starts;
  for (const std::string& text : arguments.states) {
    starts.push_back(state_of_argument(text));
  }
  if (!arguments.states_file.empty()) {
    for (const State& s : read_states(arguments.states_file)) starts.push_back(s);
  }
  const StartRegion where = arguments.random_in == "flyable"        ? StartRegion::flyable
                            : arguments.random_in == "not_obstacle" ? StartRegion::not_obstacle
                                                                    : StartRegion::safe_start;
  const auto random = random_states(plan, where, arguments.random, arguments.sampled.seed);
  if (arguments.random > 0 && random.empty()) {
    throw InputError(arguments.plan.string(), "has no cell to draw random starts from");
  }
  starts.insert(starts.end(), random.begin(), random.end());
  return starts;
}

/// Calls fly(begin, end) for batches of all flights, and tells how long the rest will take.
template <typename Fly>
void in_batches(std::size_t count, const StageClock& clock, const Fly& fly) {
  constexpr std::size_t batch = 1000;
  for (std::size_t done = 0; done < count;) {
    const std::size_t end = std::min(done + batch, count);
    fly(done, end);
    done = end;
    clock.tell(clock.seconds() / static_cast<double>(done) * static_cast<double>(count - done));
  }
}

struct Flown {
  std::vector<FlightResult> results;
  std::vector<Flight> recorded;             // only when a track is asked for
  std::optional<FinalLegTally> final_legs;  // only when the goal has a heading
};

/// `legs`: where the goal has a heading, and each flight that reaches goes on to it.
template <typename Flights, typename Record>
Flown fly(const std::vector<State>& starts, bool with_tracks, const std::optional<FinalLegs>& legs,
          const StageClock& clock, const Flights& fly_one, const Record& record_one) {
  Flown flown;
  flown.results.resize(starts.size());
  if (with_tracks) flown.recorded.resize(starts.size());
  if (legs) flown.final_legs.emplace();
  in_batches(starts.size(), clock, [&](std::size_t first, std::size_t last) {
    std::vector<Flight> batch(with_tracks || legs ? last - first : 0);
    for_ranges(last - first, 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (batch.empty()) {
          flown.results[first + i] = fly_one(starts[first + i], first + i);
          continue;
        }
        batch[i] = record_one(starts[first + i], first + i);
        if (legs) batch[i].final_leg = legs->leg_of(batch[i]);
        flown.results[first + i] = batch[i].result;
      }
    });
    for (std::size_t i = 0; i < batch.size(); ++i) {
      if (legs) flown.final_legs->add(batch[i], legs->goal());
      if (with_tracks) flown.recorded[first + i] = std::move(batch[i]);
    }
  });
  return flown;
}

Flown fly_as_asked(const SimulateArguments& arguments, const Plan& plan,
                   const std::vector<State>& starts, const StageClock& clock) {
  const bool with_tracks =
      !arguments.csv.empty() || !arguments.geojson.empty() || !arguments.qgc.empty();
  if (arguments.law == "exact") {
    const ExactFlights flights(plan);
    std::optional<FinalLegs> legs;
    if (const auto goal = goal_pose_of(plan)) legs.emplace(plan, *goal);
    return fly(
        starts, with_tracks, legs, clock,
        [&](const State& s, std::size_t) { return flights.fly(s); },
        [&](const State& s, std::size_t) { return flights.record(s); });
  }
  SampledOptions options = arguments.sampled;
  if (arguments.law == "proportional") {
    options.law = SaturatedProportional{arguments.gain_per_s};
  }
  if (!arguments.wind_mps.empty())
    options.wind_mps = {arguments.wind_mps[0], arguments.wind_mps[1]};
  if (!arguments.heading_noise.empty()) {
    options.heading_noise_rad = angle_of_argument_rad(arguments.heading_noise);
  }
  const SampledFlights flights(plan, options);
  // What a disturbed vehicle does in the goal is not known from its entry: no last leg.
  return fly(
      starts, with_tracks, std::nullopt, clock,
      [&](const State& s, std::size_t i) { return flights.fly(s, i); },
      [&](const State& s, std::size_t i) { return flights.record(s, i).flight; });
}

std::string words(const std::vector<State>& starts, const Flown& flown) {
  std::string text;
  constexpr std::size_t most_listed = 20;
  for (std::size_t i = 0; i < starts.size() && starts.size() <= most_listed; ++i) {
    const State& s = starts[i];
    const FlightResult& r = flown.results[i];
    text += fmt::format("({:g}, {:g}, {:g} rad): {}", s.position_m.x, s.position_m.y,
                        s.heading.rad(), name_of(r.outcome));
    if (std::isfinite(r.time_s))
      text += fmt::format(" after {:.2f} s, {:.1f} m", r.time_s, r.length_m);
    text += "\n";
  }
  const OutcomeCounts counts = count_outcomes(flown.results);
  text += fmt::format("Of {} flight{}, {}.", starts.size(), starts.size() == 1 ? "" : "s",
                      outcome_words(counts));
  const std::string legs = final_legs_words(flown.final_legs);
  return legs.empty() ? text : text + "\n" + legs;
}

json report(const SimulateArguments& arguments, const std::vector<State>& starts,
            const Flown& flown) {
  json flights = json::array();
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const FlightResult& r = flown.results[i];
    const bool ends = std::isfinite(r.time_s);
    flights.push_back({{"x_m", starts[i].position_m.x},
                       {"y_m", starts[i].position_m.y},
                       {"heading_rad", starts[i].heading.rad()},
                       {"outcome", name_of(r.outcome)},
                       {"time_s", ends ? json(r.time_s) : json()},
                       {"length_m", ends ? json(r.length_m) : json()}});
  }
  json all = outcome_json(count_outcomes(flown.results));
  all["plan"] = arguments.plan.string();
  all["final_legs"] = final_legs_json(flown.final_legs);
  all["flights"] = std::move(flights);
  return all;
}

/// To a file, or to stdout for "-". True when stdout was used.
bool put(const fs::path& path, const Session& session, const std::string& text) {
  if (path == "-") {
    print(text);
    return true;
  }
  write_whole(path, session.existing(), text);
  return false;
}

void check_places(const SimulateArguments& arguments, const Session& session) {
  require_places({arguments.csv, arguments.outcomes, arguments.geojson, arguments.qgc},
                 {arguments.plan, arguments.states_file}, session.existing());
}

/// The one flight as a mission, in the format that the file's name asks for.
std::string mission_text(const SimulateArguments& arguments, const Plan& plan,
                         const std::vector<Flight>& flights) {
  const std::string file = arguments.plan.string();
  if (flights.size() != 1) {
    throw InputError(arguments.qgc.string(),
                     fmt::format("a mission is one flight, and there are {} starts; give one "
                                 "--state",
                                 flights.size()));
  }
  const LonLatOf lon_lat = lon_lat_of(frame_in(plan.record), file);
  if (!lon_lat) {
    throw InputError(file,
                     "its map has no place on Earth, so that there is no latitude and longitude to "
                     "fly to; a mission needs a plan on a map in degrees or in a projected system");
  }
  const double speed_mps = plan.vehicle.speed_mps;
  return arguments.qgc.extension() == ".plan"
             ? qgc_plan_text(flights.front(), speed_mps, lon_lat, arguments.mission)
             : qgc_waypoints_text(flights.front(), speed_mps, lon_lat, arguments.mission);
}

int simulate_command(const SimulateArguments& arguments, const Session& session) {
  check_places(arguments, session);
  std::optional<TerminalProgress> terminal(std::in_place, session.quiet);
  const Progress progress = terminal->progress();
  StageClock clock(progress);
  clock.begin("reading the plan", unknown_time);
  const Plan plan = read_plan(arguments.plan);
  const std::vector<State> starts = starts_of(arguments, plan);
  clock.begin("flying", unknown_time);
  const Flown flown = fly_as_asked(arguments, plan, starts, clock);
  terminal.reset();

  const double step_m = arguments.step_m > 0.0 ? arguments.step_m : plan.grid.cell_m;
  bool stdout_used = false;
  if (!arguments.csv.empty()) {
    const std::string text = trajectories_csv(flown.recorded, plan.vehicle.speed_mps, step_m);
    stdout_used |= put(arguments.csv, session, text);
  }
  if (!arguments.geojson.empty()) {
    const LonLatOf lon_lat = lon_lat_of(frame_in(plan.record), arguments.plan.string());
    const std::string text = flights_geojson(flown.recorded, step_m, lon_lat);
    stdout_used |= put(arguments.geojson, session, text);
  }
  if (!arguments.qgc.empty()) {
    write_whole(arguments.qgc, session.existing(), mission_text(arguments, plan, flown.recorded));
  }
  if (!arguments.outcomes.empty()) {
    stdout_used |= put(arguments.outcomes, session, outcomes_csv(starts, flown.results));
  }
  if (!stdout_used) session.tell(report(arguments, starts, flown), words(starts, flown));
  return exit_done;
}

void declare_starts(CLI::App& options, SimulateArguments& a) {
  options.add_option("plan", a.plan, "the plan file")->required()->type_name("PLAN");
  options
      .add_option("--state", a.states,
                  "a start: metres, and radians or degrees with the suffix deg; may be repeated")
      ->type_name("X,Y,H")
      ->check(state_argument())
      ->allow_extra_args(false)
      ->delimiter('\0');
  options.add_option("--states", a.states_file, "starts from a CSV file: x_m,y_m,heading_rad")
      ->type_name("CSV");
  options.add_option("--random", a.random, "this many random starts")
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{100'000'000}));
  options.add_option("--seed", a.sampled.seed, "of all random draws")
      ->type_name("S")
      ->check(finite_from(0.0))
      ->capture_default_str();
  options
      .add_option("--random-in", a.random_in,
                  "safe_start: free cells that can reach the goal; flyable: free and buffer; "
                  "not_obstacle: goal cells too")
      ->check(CLI::IsMember({"safe_start", "flyable", "not_obstacle"}))
      ->type_name("WHERE")
      ->capture_default_str();
}

void declare_outputs(CLI::App& options, SimulateArguments& a) {
  options.add_option("--csv", a.csv, "write the flights' tracks; - for stdout")->type_name("FILE");
  options.add_option("--outcomes", a.outcomes, "write a line per start; - for stdout")
      ->type_name("CSV");
  options.add_option("--geojson", a.geojson, "write the flights' tracks as GeoJSON; - for stdout")
      ->type_name("FILE");
  options
      .add_option("--qgc", a.qgc,
                  "write the one flight as a mission: .plan for QGroundControl, .waypoints or .txt "
                  "for QGC WPL 110")
      ->type_name("FILE");
  options.add_option("--altitude", a.mission.altitude_m, "of the mission, metres above its start")
      ->type_name("M")
      ->check(finite_from(0.0))
      ->capture_default_str();
  options
      .add_option("--tolerance", a.mission.tolerance_m,
                  "farthest that the mission's line may be from the flight, metres")
      ->type_name("M")
      ->check(finite_above(0.0))
      ->capture_default_str();
  options
      .add_option("--step", a.step_m,
                  "longest step between points of a track, metres (default: a cell)")
      ->type_name("M")
      ->check(finite_above(0.0));
}

void declare_laws(CLI::App& options, SimulateArguments& a) {
  options.add_option("--law", a.law, "exact: the model itself; bang-bang, proportional: sampled")
      ->check(CLI::IsMember({"exact", "bang-bang", "proportional"}))
      ->type_name("LAW")
      ->capture_default_str();
  const auto sampled = [&](const char* name, auto& value, const char* does, const char* type) {
    return options.add_option(name, value, does)
        ->type_name(type)
        ->group("Sampled laws")
        ->each([&a](const std::string&) { a.sampled_only_given = true; });
  };
  const CLI::Validator positive = finite_above(0.0);
  const CLI::Validator not_negative = finite_from(0.0);
  constexpr double shortest_period_s = 1e-4;  // a flight of a minute: half a million periods
  sampled("--gain", a.gain_per_s, "proportional: turn rate per heading error, 1/s", "G")
      ->check(positive);
  sampled("--period", a.sampled.control_period_s, "control period, seconds", "S")
      ->check(finite_from(shortest_period_s));
  sampled("--position-noise", a.sampled.position_noise_m, "of the measurement, metres", "M")
      ->check(not_negative);
  sampled("--heading-noise", a.heading_noise,
          "of the measurement, radians, or degrees with the suffix deg", "H")
      ->check(angle_argument());
  sampled("--wind", a.wind_mps, "where it blows to, metres per second", "EAST,NORTH")
      ->delimiter(',')
      ->expected(2)
      ->check(finite_number());
  sampled("--gust", a.sampled.gust_mps, "standard deviation of gusts per axis", "MPS")
      ->check(not_negative);
  sampled("--gust-time", a.sampled.gust_time_s, "correlation time of gusts, seconds", "S")
      ->check(positive);
  sampled("--time-limit", a.sampled.time_limit_s, "a flight still under way then counts as trapped",
          "S")
      ->check(positive);
}

}  // namespace

Action declare_simulate(CLI::App& options) {
  auto arguments = std::make_shared<SimulateArguments>();
  SimulateArguments& a = *arguments;
  declare_starts(options, a);
  declare_outputs(options, a);
  declare_laws(options, a);
  options.final_callback([&a] {
    if (a.states.empty() && a.states_file.empty() && a.random == 0) {
      throw CLI::RequiredError("--state, --states or --random");
    }
    const auto to_stdout = [](const fs::path& path) { return path == "-" ? 1 : 0; };
    if (to_stdout(a.csv) + to_stdout(a.outcomes) + to_stdout(a.geojson) > 1) {
      throw CLI::ValidationError("--csv, --outcomes, --geojson", "only one of them can be -");
    }
    const std::string kind = a.qgc.extension().string();
    if (!a.qgc.empty() && kind != ".plan" && kind != ".waypoints" && kind != ".txt") {
      throw CLI::ValidationError("--qgc", "expected a name that ends in .plan, .waypoints or .txt");
    }
    if (a.sampled_only_given && a.law == "exact") {
      throw CLI::ValidationError(
          "--law", "noise, wind, gain, period and time limit need --law bang-bang or proportional");
    }
  });
  options.footer(
      "Without --outcomes - and the like, prints what became of the flights.\n"
      "Where the plan's goal has a heading, exact flights that reach go on by a last leg to it.\n"
      "Example: fairway simulate demo.safetensors --state 100,100,90deg --random 1000 --outcomes "
      "out.csv");
  return [arguments](const Session& session) { return simulate_command(*arguments, session); };
}

}  // namespace fairway
