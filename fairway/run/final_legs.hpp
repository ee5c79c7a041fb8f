// The last leg of a flight, where the goal has a heading: once the flight is in a goal cell the
// plan hands over to steering, which takes the vehicle to the goal's pose.
//
// Properties that always hold:
//   1. A leg begins in the state in which the flight entered the goal cell and ends at the goal's
//      pose, both but for rounding.
//   2. A leg touches no closed obstacle cell and stays on the map (steer/clear_approach.hpp: the
//      arcs and lines themselves, not samples). Buffer cells are not obstacles.
//   3. It is the shortest path where that is clear, else the shortest clear one of the approaches
//      tried. Where none is clear there is no leg, and it is counted: the flight has then reached
//      its goal cell, as the plan's verdicts mean it, and nothing is claimed beyond.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/plan/plan.hpp"
#include "fairway/simulate/flight.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

class FinalLegs {
 public:
  FinalLegs(const Plan& plan, const State& goal);

  const State& goal() const { return goal_; }

  /// The leg of a recorded flight; FinalLegState::not_asked when it does not reach.
  [[nodiscard]] FinalLeg leg_of(const Flight& flight) const;
  /// The leg of a flight that entered a goal cell in the state `entry`, `time_s` after its start.
  [[nodiscard]] FinalLeg leg_from(const State& entry, double time_s) const;

 private:
  Grid grid_;
  Vehicle vehicle_;
  State goal_;
  std::vector<std::uint8_t> blocked_;  // [iy][ix]
};

/// The results of many legs.
struct FinalLegTally {
  struct Refused {
    State start;  ///< of the flight
    State entry;  ///< into the goal cell
  };
  std::size_t count = 0;  ///< flights that reach
  std::size_t shortest = 0;
  std::size_t other = 0;
  std::size_t none_clear = 0;
  double longest_m = 0.0;
  double worst_end_error_m = 0.0;
  double worst_end_error_rad = 0.0;
  std::optional<Refused> first_refused;  ///< the first without a clear approach

  void add(const Flight& flight, const State& goal);
};

/// null when the goal has no heading.
[[nodiscard]] nlohmann::json final_legs_json(const std::optional<FinalLegTally>& tally);

/// One sentence; empty when the goal has no heading or no flight reaches.
[[nodiscard]] std::string final_legs_words(const std::optional<FinalLegTally>& tally);

}  // namespace fairway
