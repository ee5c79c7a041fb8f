// The arguments of `fairway simulate`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "fairway/app/states_asked.hpp"
#include "fairway/exchange/qgc_mission.hpp"
#include "fairway/run/flight_engine.hpp"
#include "fairway/run/fly_behaviours.hpp"
#include "fairway/simulate/sampled_flight.hpp"
#include "fairway/simulate/start_states.hpp"

namespace fairway {

struct SimulateArguments {
  std::filesystem::path plan;
  StatesAsked asked;
  std::uint64_t random = 0;
  std::string random_in = "safe_start";
  std::filesystem::path csv;
  std::filesystem::path outcomes;
  std::filesystem::path geojson;
  std::filesystem::path qgc;
  std::filesystem::path fence;
  QgcMissionOptions mission;
  double laps = 0.0;      ///< 0: not given
  double follow_s = 0.0;  ///< 0: not given
  double step_m = 0.0;    ///< 0: one cell
  std::string law = exact_law;
  double gain_per_s = SaturatedProportional{}.gain_per_s;
  SampledOptions sampled;
  std::string heading_noise;
  std::vector<double> wind_mps;
  bool sampled_only_given = false;
  std::filesystem::path contract;  ///< empty: the plan's own, when behaviours are asked for
  std::uint64_t behaviours = BehaviourRequest{}.behaviours;
  std::string adversary = "all";
  bool behaviours_given = false;

  /// Flights within a vehicle contract instead of one flight from each start.
  bool wants_behaviours() const { return !contract.empty() || behaviours_given; }
  bool wants_tracks() const { return !csv.empty() || !geojson.empty() || !qgc.empty(); }
  StartRegion start_region() const;
  /// None: flights end at the first goal cell.
  std::optional<FollowFor> follow() const;
  /// None: the exact law.
  std::optional<SampledOptions> sampled_options() const;
};

/// Declares the options and the checks between them. `arguments` must outlive `options`.
void declare(CLI::App& options, SimulateArguments& arguments);

}  // namespace fairway
