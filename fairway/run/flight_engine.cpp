#include "fairway/run/flight_engine.hpp"

#include "fairway/base/error.hpp"
#include "fairway/field/holding_circle.hpp"
#include "fairway/run/proved_modes.hpp"
#include "fairway/vehicle/path_geometry.hpp"

namespace fairway {
namespace {

using Flights = std::variant<ExactFlights, ModalFlights, SampledFlights>;

Flights flights_of(const Plan& plan, const std::optional<SampledOptions>& sampled) {
  if (sampled) return Flights(std::in_place_type<SampledFlights>, plan, *sampled);
  if (plan.further_modes() > 0) return Flights(std::in_place_type<ModalFlights>, plan);
  return Flights(std::in_place_type<ExactFlights>, plan);
}

FollowLimit limit_of(const FollowFor& follow, const PathMission& path, double speed_mps) {
  if (follow.time_s > 0.0) return {.time_s = follow.time_s};
  double path_m = 0.0;
  for_pieces(path, [&](const PathPiece& piece) { path_m += piece.length_m; });
  const double length_m = follow.laps * path_m;
  return {.length_m = length_m, .time_s = 10.0 * length_m / speed_mps};
}

/// On which the vehicle stays at its goal; on it within the room that the plan kept for it.
std::optional<PathMission> circle_of(const Plan& plan) {
  const auto* goal =
      plan.record.mission ? std::get_if<GoalMission>(&*plan.record.mission) : nullptr;
  if (goal == nullptr || !goal->hold || goal->goal_heading_rad) return {};
  const HoldingPlace place = holding_place_at(plan.grid, goal->goal_m, plan.vehicle);
  PathMission circle = path_of(place);
  circle.delta_position_m = holding_room_m(plan.grid, plan.vehicle) - place.radius_m;
  return circle;
}

}  // namespace

std::vector<std::pair<const char*, ControlLaw>> sampled_laws(double gain_per_s) {
  return {{"bang-bang", BangBang{}}, {"proportional", SaturatedProportional{gain_per_s}}};
}

std::optional<SampledOptions> options_of_law(std::string_view name, double gain_per_s,
                                             SampledOptions options) {
  if (name == exact_law) return {};
  for (auto& [known, law] : sampled_laws(gain_per_s)) {
    if (name != known) continue;
    options.law = std::move(law);
    return options;
  }
  throw PreconditionViolation("a law is named");
}

FlightEngine::FlightEngine(const Plan& plan, const std::optional<SampledOptions>& sampled)
    : plan_(plan),
      holding_(holding_cells(plan)),
      circle_(circle_of(plan)),
      flights_(flights_of(plan, sampled)) {
  const auto goal = goal_pose_of(plan);
  if (!sampled && goal) legs_.emplace(plan, *goal);
}

const PathMission* FlightEngine::path() const {
  if (circle_) return &*circle_;
  return plan_.record.mission ? std::get_if<PathMission>(&*plan_.record.mission) : nullptr;
}

FlightResult FlightEngine::told(FlightResult result, const State& start) const {
  const Cell cell = plan_.grid.cell_of(start.position_m);
  const bool holds =
      !holding_.empty() && plan_.grid.contains(cell) && holding_[plan_.grid.index(cell)] != 0;
  if (holds && result.outcome == Outcome::trapped) result.outcome = Outcome::hold;
  return result;
}

Flight FlightEngine::told(Flight flight) const {
  flight.result = told(flight.result, flight.start);
  if (circle_ && flight.onward.after == After::follow) flight.onward.after = After::hold;
  return flight;
}

template <typename Fly>
auto FlightEngine::with_decider(const State& start, const Fly& fly) const {
  if (proof_) {
    ProvedModes proved(*proof_);
    return fly(proved);
  }
  const ModeSequence found = std::get<ModalFlights>(flights_).find_modes(start);
  GivenModes given(found);
  return fly(given);
}

FlightResult FlightEngine::fly(const State& start, std::size_t index) const {
  if (const auto* exact = std::get_if<ExactFlights>(&flights_)) {
    return told(exact->fly(start), start);
  }
  if (const auto* modal = std::get_if<ModalFlights>(&flights_)) {
    return told(
        with_decider(start, [&](auto& decider) { return modal->run(start, decider).run.result; }),
        start);
  }
  return told(std::get<SampledFlights>(flights_).fly(start, index), start);
}

Flight FlightEngine::record(const State& start, std::size_t index,
                            const std::optional<FollowFor>& follow) const {
  if (follow && path() != nullptr) {
    const FollowLimit limit = limit_of(*follow, *path(), plan_.vehicle.speed_mps);
    if (const auto* exact = std::get_if<ExactFlights>(&flights_)) {
      return told(exact->follow_on(start, limit));
    }
    if (const auto* modal = std::get_if<ModalFlights>(&flights_)) {
      return told(with_decider(
          start, [&](auto& decider) { return modal->follow_on(start, decider, limit); }));
    }
    return told(std::get<SampledFlights>(flights_).follow_on(start, index, limit).flight);
  }
  Flight flight = track(start, index);
  if (legs_) flight.final_leg = legs_->leg_of(flight);
  return flight;
}

Flight FlightEngine::track(const State& start, std::size_t index) const {
  if (const auto* exact = std::get_if<ExactFlights>(&flights_)) return told(exact->record(start));
  if (const auto* modal = std::get_if<ModalFlights>(&flights_)) {
    return told(with_decider(start, [&](auto& decider) { return modal->record(start, decider); }));
  }
  return told(std::get<SampledFlights>(flights_).record(start, index).flight);
}

Flight FlightEngine::measure(const State& start, std::size_t index) const {
  if (const auto* exact = std::get_if<ExactFlights>(&flights_)) return told(exact->measure(start));
  if (const auto* modal = std::get_if<ModalFlights>(&flights_)) {
    return told(with_decider(start, [&](auto& decider) { return modal->measure(start, decider); }));
  }
  return told(std::get<SampledFlights>(flights_).measure(start, index));
}

}  // namespace fairway
