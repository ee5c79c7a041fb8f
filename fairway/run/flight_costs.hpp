// What flights cost under a plan, over all states: time and length, turning, clearance, and how
// they follow a path. Measured on exact flights from stratified states; evidence, not a proof.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/plan/plan.hpp"
#include "fairway/run/estimate_of_pairs.hpp"
#include "fairway/run/shortest_bound.hpp"
#include "fairway/simulate/flight.hpp"
#include "fairway/simulate/flight_measures.hpp"
#include "fairway/simulate/path_measures.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// Whether the mission is a closed path, to be followed: then to touch it is not enough.
[[nodiscard]] bool is_loop_to_follow(const Plan& plan);

/// One flight. Flights of a path mission are followed beyond their first path cell for the path's
/// length. Measured are those that reach; of others all but the result and the bound is 0.
struct MeasuredFlight {
  FlightResult result;
  FlightMeasures measures;
  double clearance_m = 0.0;       ///< the least, over all that was flown; +inf without obstacles
  double shortest_bound_m = 0.0;  ///< no flight from there is shorter

  /// Does what the mission asks for: reaches the goal, or the path; of a loop to be followed, and
  /// neither touches anything nor leaves while it is followed.
  bool succeeds = false;
};

struct MeasuredFlights {
  std::vector<MeasuredFlight> flights;  ///< [state]
  std::vector<bool> flown;              ///< [state]; empty: all
  std::optional<PathSpreads> path;      ///< of a path mission: over the time after joining
  std::string bound_name;
};

/// From the states that `chosen` names, [state], or all when it is empty; in parallel. `progress`
/// is called now and then with the number done. Results do not depend on the number of threads, but
/// for the last digits of the means in `path`.
[[nodiscard]] MeasuredFlights measure_flights(
    const Plan& plan, std::span<const State> states, std::vector<bool> chosen,
    const LengthBound& bound, const std::function<void(std::size_t done)>& progress = {});

/// A cost of flights: all of `part` by all of `of`, over flights that succeed.
struct CostRate {
  const char* key;
  double (*part)(const MeasuredFlight&);
  double (*of)(const MeasuredFlight&);
};
namespace cost_rate {
extern const CostRate time_s;               ///< to the goal, or to the path
extern const CostRate length_m;             ///< the same
extern const CostRate length_ratio;         ///< all lengths by all shortest bounds
extern const CostRate turned_rad_per_100m;  ///< without sign, over all that was flown
extern const CostRate reversals_per_100m;   ///< of the side of turns
}  // namespace cost_rate

/// What ratio_of_totals() and its sister take: [state], 0 for flights that do not count.
struct RateTotals {
  std::vector<double> part;
  std::vector<double> of;
};
/// Of the flights that succeed, and that `among` names, unless it is empty.
[[nodiscard]] RateTotals totals_of(const CostRate& rate, const MeasuredFlights& flown,
                                   const std::vector<bool>& among = {});

/// The least clearances of those flights.
[[nodiscard]] std::vector<double> clearances_of(const MeasuredFlights& flown,
                                                const std::vector<bool>& among = {});

struct PathCosts {
  SampledValue joined;          ///< share of those that touch the path
  SampledValue time_to_join_s;  ///< of those that join
  SampledValue distance_m;      ///< over the time of those that joined, after they did
  double distance_p95_m = 0.0;
  double distance_worst_m = 0.0;
};

struct FlightCosts {
  std::size_t states = 0;                             ///< flown
  std::array<SampledValue, outcome_codes> outcome{};  ///< [Outcome], shares of these
  SampledValue succeeds;                              ///< the same
  // Of the flights that succeed:
  SampledValue time_s;
  SampledValue length_m;
  SampledValue length_ratio;
  std::string shortest_bound;
  SampledValue turned_rad_per_100m;
  SampledValue reversals_per_100m;
  QuantileEstimate clearance_p05_m;  ///< a twentieth of the flights come nearer to an obstacle
  QuantileEstimate clearance_median_m;
  std::optional<PathCosts> path;  ///< of a path mission
};

[[nodiscard]] FlightCosts flight_costs(const MeasuredFlights& flown);

/// Over all states of the plan: those in its free and buffer cells.
[[nodiscard]] FlightCosts costs_over_all_states(const Plan& plan, std::size_t strata,
                                                std::uint64_t seed);

/// {"value", "standard_error", "states"}; value null where there is none.
[[nodiscard]] nlohmann::json estimate_json(const SampledValue& estimate);
[[nodiscard]] nlohmann::json flight_costs_json(const FlightCosts& costs);

}  // namespace fairway
