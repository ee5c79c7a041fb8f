// fairway simulate: flights under a plan file, exact or by a sampled control law.
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "fairway/app/command.hpp"
#include "fairway/app/places.hpp"
#include "fairway/app/simulate_arguments.hpp"
#include "fairway/app/states_asked.hpp"
#include "fairway/app/terminal_progress.hpp"
#include "fairway/base/error.hpp"
#include "fairway/base/share_text.hpp"
#include "fairway/exchange/flight_files.hpp"
#include "fairway/exchange/qgc_mission.hpp"
#include "fairway/map/degrees_from_frame.hpp"
#include "fairway/map/earth_frame.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/run/contract_file.hpp"
#include "fairway/run/flight_engine.hpp"
#include "fairway/run/flight_summary.hpp"
#include "fairway/run/fly_behaviours.hpp"
#include "fairway/run/fly_many.hpp"
#include "fairway/run/plan_record.hpp"
#include "fairway/run/qgc_site.hpp"
#include "fairway/run/stage_clock.hpp"
#include "fairway/run/start_warnings.hpp"
#include "fairway/simulate/start_states.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

std::vector<State> starts_of(const SimulateArguments& arguments, const Plan& plan) {
  std::vector<State> starts = states_of(arguments.asked, frame_in(plan.record), arguments.plan);
  const auto random =
      random_states(plan, arguments.start_region(), arguments.random, arguments.sampled.seed);
  if (arguments.random > 0 && random.empty()) {
    throw InputError(arguments.plan.string(), "has no cell to draw random starts from");
  }
  starts.insert(starts.end(), random.begin(), random.end());
  return starts;
}

ManyFlights flights_asked_for(const SimulateArguments& arguments, const Plan& plan,
                              const std::vector<State>& starts, const StageClock& clock) {
  FlyOptions options;
  options.tracks = arguments.wants_tracks() ? starts.size() : 0;
  options.count_legs = true;
  options.follow = arguments.follow();
  options.measure = true;
  options.progress = [&](std::size_t flown) {
    clock.tell(clock.seconds() / static_cast<double>(flown) *
               static_cast<double>(starts.size() - flown));
  };
  const FlightEngine engine(plan, arguments.sampled_options());
  if (options.follow && engine.path() == nullptr) {
    throw InputError(arguments.plan.string(),
                     "its mission is neither a path nor a goal to hold at, as --laps and --follow "
                     "require");
  }
  return fly_many(engine, starts, options);
}

VehicleContract contract_asked_for(const SimulateArguments& arguments, const Plan& plan) {
  if (!arguments.contract.empty()) return read_contract(arguments.contract, plan.vehicle);
  if (plan.record.contract) return *plan.record.contract;
  throw InputError(arguments.plan.string(),
                   "has no vehicle contract, expected --contract FILE.toml with --behaviours or "
                   "--adversary");
}

FlownBehaviours behaviours_asked_for(const SimulateArguments& arguments, const Plan& plan,
                                     const std::vector<State>& starts, const StageClock& clock) {
  BehaviourRequest request;
  request.contract = contract_asked_for(arguments, plan);
  request.behaviours = arguments.behaviours;
  request.adversaries = adversaries_of(arguments.adversary);
  request.seed = arguments.sampled.seed;
  request.record = arguments.wants_tracks();
  request.progress = [&](std::size_t flown) {
    clock.tell(clock.seconds() / static_cast<double>(flown) *
               static_cast<double>(starts.size() - flown));
  };
  return fly_behaviours(plan, starts, request);
}

/// The worst flight of each start, for the files that all flights are written to.
ManyFlights worst_of(const FlownBehaviours& behaviours, bool recorded) {
  ManyFlights flown;
  for (const Flight& flight : behaviours.worst) {
    flown.results.push_back(flight.result);
    flown.measures.push_back({flight.turning, {}, {}});
  }
  if (recorded) flown.recorded = behaviours.worst;
  return flown;
}

/// Where random starts were drawn from, and their number when there are other starts too.
std::string drawn_words(const SimulateArguments& arguments, std::size_t starts) {
  if (arguments.random == 0) return {};
  const StartRegion region = arguments.start_region();
  const std::string from = region == StartRegion::safe_start ? "random safe starts with a command"
                           : region == StartRegion::flyable
                               ? "random states in free and buffer cells"
                               : "random states outside obstacles";
  if (arguments.random == starts) return " from " + from;
  return fmt::format(" ({} of them from {})", grouped(arguments.random), from);
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
                 {arguments.plan, arguments.asked.file, arguments.fence, arguments.contract},
                 session.existing());
}

/// What the exported plan keeps in addition to the mission.
QgcSite site_of(const SimulateArguments& arguments, const Plan& plan, const Session& session) {
  if (arguments.qgc.extension() != ".plan") return {};
  if (!arguments.fence.empty()) return qgc_site_of(arguments.fence);
  if (auto site = qgc_site_of(plan.record, arguments.plan.parent_path())) return *site;
  session.warn(no_fence_warning(plan.record, "--fence FILE.plan"));
  return {};
}

/// The one flight as a mission, in the format that the file's name asks for.
std::string mission_text(const SimulateArguments& arguments, const Plan& plan,
                         const std::vector<Flight>& flights, const Session& session) {
  const std::string file = arguments.plan.string();
  if (flights.size() != 1) {
    throw InputError(arguments.qgc.string(),
                     fmt::format("a mission is a single flight, but there are {} starts; give one "
                                 "--state",
                                 flights.size()));
  }
  const LonLatOf lon_lat = lon_lat_of(frame_in(plan.record), file);
  if (!lon_lat) {
    throw InputError(file,
                     "the plan's map is not georeferenced, so waypoints have no latitude and "
                     "longitude; a mission needs a map in degrees or in a projected system");
  }
  QgcMissionOptions mission = arguments.mission;
  mission.site = site_of(arguments, plan, session);
  return qgc_mission_text(arguments.qgc, flights.front(), plan.vehicle.speed_mps, lon_lat, mission);
}

int simulate_command(const SimulateArguments& arguments, const Session& session) {
  check_places(arguments, session);
  std::optional<TerminalProgress> terminal(std::in_place, session.quiet);
  const Progress progress = terminal->progress();
  StageClock clock(progress);
  clock.begin("reading the plan", unknown_time);
  const Plan plan = read_plan(arguments.plan);
  const std::vector<State> starts = starts_of(arguments, plan);
  const std::size_t given = starts.size() - arguments.random;
  for (const std::string& warning :
       degree_warnings(std::span(starts).first(given), plan.grid, frame_in(plan.record)))
    session.warn(warning);
  clock.begin("flying", unknown_time);
  std::optional<FlownBehaviours> behaviours;
  if (arguments.wants_behaviours())
    behaviours = behaviours_asked_for(arguments, plan, starts, clock);
  const ManyFlights flown = behaviours ? worst_of(*behaviours, arguments.wants_tracks())
                                       : flights_asked_for(arguments, plan, starts, clock);
  terminal.reset();

  const double step_m = arguments.step_m > 0.0 ? arguments.step_m : plan.grid.cell_m;
  const bool has_modes = plan.further_modes() > 0;
  bool stdout_used = false;
  if (!arguments.csv.empty()) {
    const std::string text =
        trajectories_csv(flown.recorded, plan.vehicle.speed_mps, step_m, has_modes);
    stdout_used |= put(arguments.csv, session, text);
  }
  if (!arguments.geojson.empty()) {
    const LonLatOf lon_lat = lon_lat_of(frame_in(plan.record), arguments.plan.string());
    const std::string text = flights_geojson(flown.recorded, step_m, lon_lat);
    stdout_used |= put(arguments.geojson, session, text);
  }
  if (!arguments.qgc.empty()) {
    write_whole(arguments.qgc, session.existing(),
                mission_text(arguments, plan, flown.recorded, session));
    for (const std::string& warning : mission_warnings(flown.recorded)) session.warn(warning);
  }
  if (!arguments.outcomes.empty()) {
    stdout_used |= put(
        arguments.outcomes, session,
        outcomes_csv(starts, flown.results, flown.measures, flown.followed.has_value(), has_modes));
  }
  if (!stdout_used) {
    std::optional<EarthFrame> earth;
    if (frame_in(plan.record).is_on_earth())
      earth.emplace(frame_in(plan.record), arguments.plan.string());
    const EarthFrame* degrees = earth ? &*earth : nullptr;
    nlohmann::json report =
        behaviours ? behaviour_json(*behaviours, degrees) : flight_json(starts, flown, degrees);
    report["plan"] = arguments.plan.string();
    const std::string drawn = drawn_words(arguments, starts.size());
    session.tell(report, behaviours ? behaviour_words(*behaviours, drawn)
                                    : flight_words(starts, flown, drawn, degrees));
  }
  return exit_done;
}

}  // namespace

Action declare_simulate(CLI::App& options) {
  auto arguments = std::make_shared<SimulateArguments>();
  declare(options, *arguments);
  return [arguments](const Session& session) { return simulate_command(*arguments, session); };
}

}  // namespace fairway
