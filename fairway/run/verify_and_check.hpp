// plan -> what is known of all its states: certificate or bitmap in its file, checked, drawn.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "fairway/ceiling/ceiling.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/run/scenario.hpp"
#include "fairway/run/scenario_flights.hpp"
#include "fairway/run/stage_clock.hpp"
#include "fairway/run/verified.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/verify/region_of_interest.hpp"

namespace fairway {

/// As the scenario's verify.method says, with the products in the folder `place`. Starts of `flown`
/// that fail are among the failing states. `after_s`: what the run will take afterwards. Throws
/// std::runtime_error when the separate program refuses the certificate.
[[nodiscard]] Verified verify_and_check(const Plan& plan, const Scenario& scenario,
                                        const RegionOfInterest& region,
                                        const ScenarioFlights& flown,
                                        const std::filesystem::path& place, StageClock& clock,
                                        double after_s);

/// What any control could keep of what was proved, if the scenario asks for it. `as_asked`: the
/// plan as verified.
[[nodiscard]] std::optional<Ceiling> ceiling_asked(const Scenario& scenario, const Plan& as_asked,
                                                   const Verified& verified, StageClock& clock);

/// The plan with what was to be reached as its goal: what verdicts and their flights are about.
[[nodiscard]] Plan as_verified(const Plan& plan, const Verified& verified);

/// Into the folder `place`. `plan` and `flights`: as verified.
void write_verified_pictures(const Plan& plan, const ExactFlights& flights,
                             const Verified& verified, std::uint64_t seed, const std::string& title,
                             const std::filesystem::path& place);

}  // namespace fairway
