#include "fairway/run/final_legs.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fairway/run/path_segments.hpp"
#include "fairway/steer/clear_approach.hpp"
#include "fairway/steer/dubins_words.hpp"

namespace fairway {
namespace {

using nlohmann::json;

/// Appends the parts of a path to a leg.
void append(FinalLeg& leg, const DubinsPath& path, double entry_s, double speed_mps) {
  for (FlightSegment piece : segments_of(path)) {
    piece.time_s = entry_s + leg.length_m / speed_mps;
    leg.length_m += piece.length_m;
    leg.segments.push_back(piece);
  }
  leg.time_s = leg.length_m / speed_mps;
}

/// "L", "R" or "S" for a lead of one part.
std::string word_of_lead(const DubinsPath& lead) {
  for (const DubinsPart& part : parts_of(lead)) {
    if (!(part.length_m > 0.0)) continue;
    return part.turn == 0 ? "S" : part.turn > 0 ? "L" : "R";
  }
  return "";
}

json state_json(const State& s) { return {s.position_m.x, s.position_m.y, s.heading.rad()}; }

}  // namespace

FinalLegs::FinalLegs(const Plan& plan, const State& goal)
    : grid_(plan.grid), vehicle_(plan.vehicle), goal_(goal), blocked_(plan.region.size()) {
  std::transform(plan.region.begin(), plan.region.end(), blocked_.begin(),
                 [](Region region) { return region == Region::obstacle ? 1 : 0; });
}

FinalLeg FinalLegs::leg_of(const Flight& flight) const {
  if (flight.result.outcome != Outcome::reach) return {};
  return leg_from(end_of(flight), flight.result.time_s);
}

FinalLeg FinalLegs::leg_from(const State& entry, double time_s) const {
  FinalLeg leg;
  leg.entry = entry;
  const BlockedCells cells{grid_, blocked_, true};
  const DubinsPath shortest = shortest_path(leg.entry, goal_, vehicle_.turn_radius_m);
  if (is_clear(shortest, cells)) {
    leg.state = FinalLegState::shortest;
    leg.word = name_of(shortest.word);
    append(leg, shortest, time_s, vehicle_.speed_mps);
    return leg;
  }
  const auto approach = first_clear_approach(leg.entry, goal_, vehicle_.turn_radius_m, cells);
  if (!approach) {
    leg.state = FinalLegState::none_clear;
    return leg;
  }
  leg.state = FinalLegState::other;
  const std::string lead = word_of_lead(approach->lead);
  leg.word = lead + (lead.empty() ? "" : "+") + name_of(approach->path.word);
  append(leg, approach->lead, time_s, vehicle_.speed_mps);
  append(leg, approach->path, time_s, vehicle_.speed_mps);
  return leg;
}

void FinalLegTally::add(const Flight& flight, const State& goal) {
  const FinalLeg& leg = flight.final_leg;
  if (leg.state == FinalLegState::not_asked) return;
  ++count;
  if (leg.state == FinalLegState::none_clear) {
    ++none_clear;
    if (!first_refused) first_refused = {flight.start, leg.entry};
    return;
  }
  ++(leg.state == FinalLegState::shortest ? shortest : other);
  longest_m = std::max(longest_m, leg.length_m);
  const State end = leg.segments.empty()
                        ? leg.entry
                        : state_at(leg.segments.back(), leg.segments.back().length_m);
  worst_end_error_m = std::max(worst_end_error_m, norm(end.position_m - goal.position_m));
  worst_end_error_rad = std::max(worst_end_error_rad, std::abs(end.heading.turn_to(goal.heading)));
}

json final_legs_json(const std::optional<FinalLegTally>& tally) {
  if (!tally) return {};
  json refused;
  if (tally->first_refused) {
    refused = {{"start", state_json(tally->first_refused->start)},
               {"entry", state_json(tally->first_refused->entry)}};
  }
  return {{"count", tally->count},
          {"shortest", tally->shortest},
          {"other", tally->other},
          {"none_clear", tally->none_clear},
          {"longest_m", tally->longest_m},
          {"worst_end_error_m", tally->worst_end_error_m},
          {"worst_end_error_rad", tally->worst_end_error_rad},
          {"first_none_clear", refused}};
}

std::string final_legs_words(const std::optional<FinalLegTally>& tally) {
  if (!tally || tally->count == 0) return {};
  std::string words = fmt::format(
      "Of the {} flights that reach, {} go on to the goal's heading by the shortest path and {} by "
      "another approach, all clear of obstacles; the longest leg is {:.1f} m.",
      tally->count, tally->shortest, tally->other, tally->longest_m);
  if (tally->none_clear > 0) {
    words += fmt::format(
        " For {}, none of the approaches tried is clear: they enter the goal but do not reach its "
        "heading.",
        tally->none_clear);
  }
  return words;
}

}  // namespace fairway
