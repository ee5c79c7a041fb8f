#include "fairway/app/simulate_arguments.hpp"

#include "fairway/app/argument_checks.hpp"

namespace fairway {
namespace {

void declare_starts(CLI::App& options, SimulateArguments& a) {
  options.add_option("plan", a.plan, "the plan file")->required()->type_name("PLAN");
  declare_states(options, a.asked, "start");
  options.add_option("--random", a.random, "number of random starts")
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{100'000'000}));
  options.add_option("--seed", a.sampled.seed, "random seed")
      ->type_name("S")
      ->check(finite_from(0.0))
      ->capture_default_str();
  options
      .add_option("--random-in", a.random_in,
                  "cells to draw random starts from; safe_start: free cells with a command; "
                  "flyable: free and buffer cells; not_obstacle: goal cells too")
      ->check(CLI::IsMember({"safe_start", "flyable", "not_obstacle"}))
      ->type_name("WHERE")
      ->capture_default_str();
}

void declare_outputs(CLI::App& options, SimulateArguments& a) {
  options.add_option("--csv", a.csv, "write the flights' tracks as CSV; - for stdout")
      ->type_name("FILE");
  options.add_option("--outcomes", a.outcomes, "write one line per start as CSV; - for stdout")
      ->type_name("CSV");
  options.add_option("--geojson", a.geojson, "write the flights' tracks as GeoJSON; - for stdout")
      ->type_name("FILE");
  options
      .add_option(
          "--qgc", a.qgc,
          "write a single flight as a mission: .plan for QGroundControl, .waypoints or .txt "
          "for QGC WPL 110")
      ->type_name("FILE");
  options
      .add_option("--fence", a.fence,
                  "a QGroundControl .plan whose fence, rally points and home altitude the exported "
                  ".plan keeps (default: the one the map was read from)")
      ->type_name("PLAN");
  options
      .add_option("--altitude", a.mission.altitude_m, "mission altitude above its start, metres")
      ->type_name("M")
      ->check(finite_from(0.0))
      ->capture_default_str();
  options
      .add_option("--tolerance", a.mission.tolerance_m,
                  "maximum distance of the mission's line from the flight, metres")
      ->type_name("M")
      ->check(finite_above(0.0))
      ->capture_default_str();
  options
      .add_option("--step", a.step_m,
                  "maximum distance between points of a track, metres (default: one cell)")
      ->type_name("M")
      ->check(finite_above(0.0));
}

void declare_following(CLI::App& options, SimulateArguments& a) {
  options
      .add_option(
          "--laps", a.laps,
          "after reaching the path, or the goal to hold at, follow it for N times its length, or N "
          "times round the circle")
      ->type_name("N")
      ->check(finite_above(0.0));
  options
      .add_option("--follow", a.follow_s,
                  "after reaching the path, or the goal to hold at, follow it for S seconds")
      ->type_name("S")
      ->check(finite_above(0.0));
}

std::vector<std::string> law_names() {
  std::vector<std::string> names{exact_law};
  for (const auto& [name, law] : sampled_laws(1.0)) names.emplace_back(name);
  return names;
}

void declare_laws(CLI::App& options, SimulateArguments& a) {
  options
      .add_option("--law", a.law,
                  "exact: the model itself; bang-bang and proportional: sampled control laws")
      ->check(CLI::IsMember(law_names()))
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
  sampled("--gain", a.gain_per_s, "law proportional: turn rate per heading error, 1/s", "G")
      ->check(positive);
  sampled("--period", a.sampled.control_period_s, "control period, seconds", "S")
      ->check(finite_from(shortest_period_s));
  sampled("--position-noise", a.sampled.position_noise_m,
          "standard deviation of the measured position, metres", "M")
      ->check(not_negative);
  sampled("--heading-noise", a.heading_noise,
          "standard deviation of the measured heading, radians, or degrees with the suffix deg",
          "H")
      ->check(angle_argument());
  sampled("--wind", a.wind_mps, "wind velocity (the direction it blows to), metres per second",
          "EAST,NORTH")
      ->delimiter(',')
      ->expected(2)
      ->check(finite_number());
  sampled("--gust", a.sampled.gust_mps, "standard deviation of gusts per axis, metres per second",
          "MPS")
      ->check(not_negative);
  sampled("--gust-time", a.sampled.gust_time_s, "correlation time of gusts, seconds", "S")
      ->check(positive);
  sampled("--time-limit", a.sampled.time_limit_s,
          "time after which an unfinished flight counts as trapped, seconds", "S")
      ->check(positive);
}

void declare_behaviours(CLI::App& options, SimulateArguments& a) {
  std::vector<std::string> adversaries{"all"};
  for (const Adversary adversary : adversaries_in_order)
    adversaries.emplace_back(name_of(adversary));
  const auto option = [&](const char* name, auto& value, const char* does, const char* type) {
    return options.add_option(name, value, does)->type_name(type)->group("Vehicle contract");
  };
  option("--contract", a.contract,
         "fly behaviours of vehicles that keep the contract of this file ([vehicle.contract]); "
         "flights and outcomes written are the worst of each start",
         "TOML");
  const auto given = [&a](const std::string&) { a.behaviours_given = true; };
  option("--behaviours", a.behaviours,
         "number of behaviours from each start (without --contract: within the plan's contract)",
         "N")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000}))
      ->capture_default_str()
      ->each(given);
  option("--adversary", a.adversary,
         "random: whatever the contract allows; greedy: towards obstacles; circling: round one "
         "side; guided: searches for a way to fail; all: by turns",
         "WHICH")
      ->check(CLI::IsMember(adversaries))
      ->capture_default_str()
      ->each(given);
}

void check_behaviours(const SimulateArguments& a) {
  if (!a.wants_behaviours()) return;
  if (a.law != exact_law) throw CLI::ExcludesError("--law", "--contract");
  if (a.laps > 0.0 || a.follow_s > 0.0) throw CLI::ExcludesError("--laps, --follow", "--contract");
  if (!a.qgc.empty()) throw CLI::ExcludesError("--qgc", "--contract");
}

void check(const SimulateArguments& a) {
  if (a.asked.empty() && a.random == 0) {
    throw CLI::RequiredError("--state, --state-deg, --states or --random");
  }
  const auto to_stdout = [](const std::filesystem::path& path) { return path == "-" ? 1 : 0; };
  if (to_stdout(a.csv) + to_stdout(a.outcomes) + to_stdout(a.geojson) > 1) {
    throw CLI::ValidationError("--csv, --outcomes, --geojson", "only one of them can be -");
  }
  if (!a.qgc.empty() && !is_qgc_mission_name(a.qgc)) {
    throw CLI::ValidationError("--qgc", "expected a name that ends in .plan, .waypoints or .txt");
  }
  check_behaviours(a);
  constexpr double most = 1e9;
  if (a.laps > 0.0 && a.follow_s > 0.0) throw CLI::ExcludesError("--laps", "--follow");
  if (a.laps > most || a.follow_s > most) {
    throw CLI::ValidationError("--laps, --follow", "expected at most 1e9");
  }
  if (!a.fence.empty() && a.qgc.extension() != ".plan") {
    throw CLI::ValidationError("--fence",
                               "needs --qgc FILE.plan: other mission formats have no fence");
  }
  if (a.sampled_only_given && a.law == exact_law) {
    throw CLI::ValidationError(
        "--law", "noise, wind, gain, period and time limit need --law bang-bang or proportional");
  }
}

}  // namespace

StartRegion SimulateArguments::start_region() const {
  return random_in == "flyable"        ? StartRegion::flyable
         : random_in == "not_obstacle" ? StartRegion::not_obstacle
                                       : StartRegion::safe_start;
}

std::optional<FollowFor> SimulateArguments::follow() const {
  if (laps == 0.0 && follow_s == 0.0) return {};
  return FollowFor{.laps = laps, .time_s = follow_s};
}

std::optional<SampledOptions> SimulateArguments::sampled_options() const {
  SampledOptions options = sampled;
  if (!wind_mps.empty()) options.wind_mps = {wind_mps[0], wind_mps[1]};
  if (!heading_noise.empty()) {
    options.heading_noise_rad = angle_of_argument_rad(heading_noise);
  }
  return options_of_law(law, gain_per_s, options);
}

void declare(CLI::App& options, SimulateArguments& a) {
  declare_starts(options, a);
  declare_outputs(options, a);
  declare_following(options, a);
  declare_laws(options, a);
  declare_behaviours(options, a);
  options.final_callback([&a] { check(a); });
  options.footer(
      "Prints a summary of the outcomes unless one of the outputs goes to stdout.\n"
      "If the plan's goal has a heading, exact flights that reach it continue with a last leg to\n"
      "that heading. Flights of a path mission, or to a goal to hold at, end where they reach it,\n"
      "unless --laps or --follow is given; what happens afterwards is then reported separately.\n"
      "With --contract, each start is flown by many behaviours of vehicles that keep the "
      "contract;\n"
      "one that fails is proved to be within it where the summary says so. Its wind is taken as\n"
      "calm.\n"
      "Uploading an exported .plan replaces the vehicle's mission, fence and rally points.\n"
      "Example: fairway simulate demo.safetensors --state 100,100,90deg --random 1000 --outcomes "
      "out.csv");
}

}  // namespace fairway
