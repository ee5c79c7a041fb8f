// What a real autopilot does with a plan: flights with a sampled control law, noise and wind.
//
// Paper 1, Eq. 8: in the buffer the vehicle turns at its limit towards the field's heading (bang-
// bang); outside it, on safe starts and on the cells of a path, any control law z may act. Every
// control period the vehicle measures its state (with noise), looks up the command of the cell it
// believes to be in, and holds the demanded turn rate until the next one. No command, or a measured
// place outside the grid: no turn.
//
// Motion in a period is exact: an arc through the air, plus the drift of the wind (a trochoid over
// the ground). Wind is constant; gusts are two independent first-order Gauss-Markov processes
// (east, north): g' = -g / T + white noise, stationary with standard deviation gust_mps and
// correlation time T = gust_time_s, held constant within a period. The air speed is the plan's
// speed.
//
// Collision and goal tests walk the straight chord between points of the ground track at most
// cell_m / 8 apart, through every cell the chord meets: within (cell_m / 8)^2 / (8 r) of the track
// without wind, under 1/512 of a cell. This is evidence of what happens, not exact_flight.hpp.
//
// Properties that always hold: flight i depends on the plan, the options and i alone. The demanded
// rate never exceeds speed / turn radius. `trapped` here means: not ended within the time limit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <variant>
#include <vector>

#include "fairway/plan/plan.hpp"
#include "fairway/simulate/flight.hpp"

namespace fairway {

/// What a control law sees.
struct Measurement {
  State state;                     ///< with noise
  double heading_error_rad = 0.0;  ///< command minus heading, (-pi, pi] (Eq. 9)
  double time_s = 0.0;
};

/// Full rate towards the command; only as far as it within one period (else it would swing about it
/// by half a period's turn). Tends to the exact flights' law as the period goes to 0.
struct BangBang {};

/// Rate gain_per_s times the heading error, up to the vehicle's limit.
struct SaturatedProportional {
  double gain_per_s = 1.0;  ///< > 0
};

/// Any law: the demanded turn rate in rad/s, positive to the left; the vehicle's limit is applied
/// afterwards. Called from several threads at once; must depend on its argument alone.
using CustomLaw = std::function<double(const Measurement&)>;

using ControlLaw = std::variant<BangBang, SaturatedProportional, CustomLaw>;

struct SampledOptions {
  ControlLaw law = BangBang{};
  double control_period_s = 0.05;  ///< > 0
  double position_noise_m = 0.0;   ///< standard deviation per axis, >= 0
  double heading_noise_rad = 0.0;  ///< standard deviation, >= 0
  Vec2 wind_mps{};                 ///< blows towards
  double gust_mps = 0.0;           ///< standard deviation per axis, >= 0
  double gust_time_s = 3.0;        ///< correlation time, > 0
  double time_limit_s = 0.0;       ///< 0: the time for 20 (nx + ny) cells or 4 times the cost to go
  std::uint64_t seed = 1;
};

/// At a control instant.
struct FlightSample {
  double time_s = 0.0;
  State state;  ///< true, over the ground; the heading is the vehicle's, not its course
  double turn_rate_radps = 0.0;
  Vec2 wind_mps;
};

struct SampledFlight {
  Flight flight;  ///< pieces over the ground: arcs without wind, chords of the track with wind
  std::vector<FlightSample> samples;
};

class SampledFlights {
 public:
  /// `plan` must outlive this. Throws PreconditionViolation when an option is out of range or the
  /// plan's arrays do not fit its grid.
  SampledFlights(const Plan& plan, SampledOptions options);
  SampledFlights(Plan&&, SampledOptions) = delete;

  /// `index` picks the random draws. length_m is over the ground.
  [[nodiscard]] FlightResult fly(const State& start, std::size_t index) const;
  [[nodiscard]] SampledFlight record(const State& start, std::size_t index) const;
  /// The same without pieces and samples: result and turning. Turning is that of the vehicle, not
  /// of its track: a millionth of the tightest turn counts as straight.
  [[nodiscard]] Flight measure(const State& start, std::size_t index) const;
  /// For path missions: recorded until `beyond` the first goal cell, or to an obstacle or the
  /// grid's edge. The result is that of `fly`, to the bit, and the time limit holds up to there.
  /// Throws PreconditionViolation unless a limit is finite and both are > 0.
  [[nodiscard]] SampledFlight follow_on(const State& start, std::size_t index,
                                        const FollowLimit& beyond) const;

  /// In parallel; start [i] flies with index i.
  [[nodiscard]] std::vector<FlightResult> fly_all(std::span<const State> starts) const;

 private:
  class Run;
  SampledFlight recorded(const State& start, std::size_t index, const FollowLimit* beyond) const;

  const Plan& plan_;
  SampledOptions options_;
};

}  // namespace fairway
