// The pictures of a run: plan, flights, headings; for paths, distances; for goals with a heading,
// a close-up of the last legs.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "fairway/inclusion/follow_proof.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/run/scenario_flights.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway {

/// Names of the pictures a run may have, without extension.
inline constexpr std::array<const char*, 5> run_pictures{"plan", "flights", "headings", "distance",
                                                         "final_legs"};

/// Writes NAME.svg and NAME.png into `folder` for every picture. `follow`: the proof that the path
/// is followed, whose tube is drawn; or none.
void write_run_pictures(const Plan& plan, const Mission& mission, const ScenarioFlights& flown,
                        const FollowProof* follow, const std::string& title,
                        const std::filesystem::path& folder);

}  // namespace fairway
