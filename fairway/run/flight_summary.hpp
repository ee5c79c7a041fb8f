// What became of flights, as JSON and in words.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

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
/// `drawn`: where the starts were drawn from, " from ..."; empty: nowhere.
[[nodiscard]] std::string flight_words(std::span<const State> starts, const ManyFlights& flown,
                                       const std::string& drawn = {});

/// Every flight, their counts and the last legs. There are as many starts as results.
[[nodiscard]] nlohmann::json flight_json(std::span<const State> starts, const ManyFlights& flown);

}  // namespace fairway
