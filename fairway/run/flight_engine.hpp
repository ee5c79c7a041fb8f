// Flights under a plan, exact or by a sampled law, and the last leg of those that reach.
//
// Properties that always hold:
//   1. A flight depends on the plan, the law and the start alone; under a sampled law also on its
//      index, which picks the random draws. Several threads may ask at once.
//   2. Exact flights that reach continue to the goal's pose if the goal has a heading. Sampled ones
//      do not: what a disturbed vehicle does in the goal is not known from its entry.
//   3. Under a plan with modes exact flights change modes on the way (docs/modes.md): as the proof
//      says where one is given, else as trials find it (ModalFlights::find_modes). Sampled flights
//      keep to mode 0.
//   4. Who is trapped where the plan holds (holding_cells) is told to hold.
// Cost: that of the flights, and 25 bytes a cell for exact ones while the object lives; 24 more for
// each further mode.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "fairway/plan/plan.hpp"
#include "fairway/run/final_legs.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/simulate/modal_flight.hpp"
#include "fairway/simulate/sampled_flight.hpp"
#include "fairway/verify/proof_view.hpp"

namespace fairway {

/// The name of the model's own law, flown without sampling.
inline constexpr const char* exact_law = "exact";

/// The sampled laws that have a name. `gain_per_s` > 0: of the proportional one.
[[nodiscard]] std::vector<std::pair<const char*, ControlLaw>> sampled_laws(double gain_per_s);

/// How the law of that name flies: none for exact_law, else `options` with that law. Throws
/// PreconditionViolation when no law has the name.
[[nodiscard]] std::optional<SampledOptions> options_of_law(std::string_view name, double gain_per_s,
                                                           SampledOptions options);

/// For how long flights of path missions, and of goals to hold at, are followed beyond their first
/// goal cell: one of the two is > 0, finite, and counts.
struct FollowFor {
  double laps = 0.0;  ///< times the length of the path, or of the circle, over the ground
  double time_s = 0.0;
};
inline constexpr FollowFor one_lap{.laps = 1.0};
/// About a goal: it may have to turn round first.
inline constexpr FollowFor five_laps{.laps = 5.0};

class FlightEngine {
 public:
  /// Exact without `sampled`. `plan` must outlive this. Throws PreconditionViolation as
  /// ExactFlights and SampledFlights do.
  explicit FlightEngine(const Plan& plan, const std::optional<SampledOptions>& sampled = {});
  FlightEngine(Plan&&, const std::optional<SampledOptions>& = {}) = delete;
  FlightEngine(const FlightEngine&) = delete;
  FlightEngine& operator=(const FlightEngine&) = delete;
  ~FlightEngine() = default;

  /// What is proved of the plan and its modes decides which mode is flown. Not while others ask;
  /// what `proof` refers to must outlive this.
  void decide_by(const ProofView& proof) { proof_ = proof; }

  [[nodiscard]] FlightResult fly(const State& start, std::size_t index) const;

  /// With its pieces and its last leg; along the path, where there is one and `follow`
  /// says for how long. The result is still that of `fly`. Following by laps ends after ten
  /// times the time they take in calm air, wherever the wind has held the vehicle.
  [[nodiscard]] Flight record(const State& start, std::size_t index,
                              const std::optional<FollowFor>& follow = {}) const;

  /// With its pieces, to the first goal cell.
  [[nodiscard]] Flight track(const State& start, std::size_t index) const;

  /// Result and turning alone.
  [[nodiscard]] Flight measure(const State& start, std::size_t index) const;

  /// The path of the plan's mission, or the circle about the goal that it holds at; else null.
  const PathMission* path() const;
  /// Whether that is a circle about a goal.
  bool holds() const { return circle_.has_value(); }
  const Plan& plan() const { return plan_; }

  bool has_modes() const { return std::holds_alternative<ModalFlights>(flights_); }
  /// None under a sampled law, or when the goal has no heading.
  const std::optional<FinalLegs>& legs() const { return legs_; }

 private:
  FlightResult told(FlightResult result, const State& start) const;
  Flight told(Flight flight) const;
  template <typename Fly>
  auto with_decider(const State& start, const Fly& fly) const;

  const Plan& plan_;
  std::vector<std::uint8_t> holding_;  // holding_cells
  std::optional<PathMission> circle_;
  std::variant<ExactFlights, ModalFlights, SampledFlights> flights_;
  std::optional<ProofView> proof_;
  std::optional<FinalLegs> legs_;
};

}  // namespace fairway
