#include "fairway/run/flight_engine.hpp"

#include <cmath>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

using Flights = std::variant<ExactFlights, SampledFlights>;

Flights flights_of(const Plan& plan, const std::optional<SampledOptions>& sampled) {
  if (sampled) return Flights(std::in_place_type<SampledFlights>, plan, *sampled);
  return Flights(std::in_place_type<ExactFlights>, plan);
}

const PathMission* path_in(const Plan& plan) {
  return plan.record.mission ? std::get_if<PathMission>(&*plan.record.mission) : nullptr;
}

double length_m(const PathMission& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.vertices_m.size(); ++i) {
    length += norm(path.vertices_m[i] - path.vertices_m[i - 1]);
  }
  if (path.closed) length += norm(path.vertices_m.front() - path.vertices_m.back());
  return length;
}

/// To the path by the plan, then once along it.
double track_length_m(const Plan& plan, const PathMission& path, const State& start) {
  const float cost_m = plan.cost_m[plan.grid.index(plan.grid.cell_of(start.position_m))];
  return (std::isfinite(cost_m) ? static_cast<double>(cost_m) : 0.0) + length_m(path);
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
    : plan_(plan), flights_(flights_of(plan, sampled)) {
  const auto goal = goal_pose_of(plan);
  if (!sampled && goal) legs_.emplace(plan, *goal);
}

bool FlightEngine::goes_on(TrackEnd end) const {
  return end == TrackEnd::path && exact() != nullptr && path_in(plan_) != nullptr;
}

FlightResult FlightEngine::fly(const State& start, std::size_t index) const {
  if (const ExactFlights* flights = exact()) return flights->fly(start);
  return std::get<SampledFlights>(flights_).fly(start, index);
}

Flight FlightEngine::record(const State& start, std::size_t index, TrackEnd end) const {
  const ExactFlights* flights = exact();
  if (flights == nullptr) return std::get<SampledFlights>(flights_).record(start, index).flight;
  if (goes_on(end)) {
    return flights->follow(start, track_length_m(plan_, *path_in(plan_), start));
  }
  Flight flight = flights->record(start);
  if (legs_) flight.final_leg = legs_->leg_of(flight);
  return flight;
}

}  // namespace fairway
