// The results of flights, as JSON and in words.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

#include "fairway/map/earth_frame.hpp"
#include "fairway/run/fly_many.hpp"
#include "fairway/run/scenario_flights.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// A sentence each for a scenario's random flights, its given ones and the last legs, followed by a
/// space; none for what was not flown.
[[nodiscard]] std::string flight_words(const ScenarioFlights& flown);

/// The flights' members of summary.json. `seed`: of the random ones.
void add_flights(nlohmann::json& summary, const ScenarioFlights& flown, std::uint64_t seed);

/// A line for each flight while there are few of them, then one for all, and one for the last legs.
/// `drawn`: where the starts were drawn from, " from ..."; empty: nowhere. With `earth`, starts are
/// given in degrees, too.
[[nodiscard]] std::string flight_words(std::span<const State> starts, const ManyFlights& flown,
                                       const std::string& drawn = {},
                                       const EarthFrame* earth = nullptr);

/// Every flight, their counts and the last legs. There are as many starts as results.
/// With `earth`, starts are given in degrees, too.
[[nodiscard]] nlohmann::json flight_json(std::span<const State> starts, const ManyFlights& flown,
                                         const EarthFrame* earth = nullptr);

/// "lat_deg", "lon_deg" and "course_deg" of a state, added to its object: to a tenth of a
/// millimetre and 1e-6 degrees.
void add_degrees(nlohmann::json& object, const State& state, const EarthFrame& earth);

}  // namespace fairway
