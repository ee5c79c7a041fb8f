// Flights as text, CSV and GeoJSON (docs/formats.md).
//
// Numbers in CSV are the shortest decimals that read back as the same double; a trapped flight has
// `inf` for time and length. The writers give the whole text; base/atomic_file.hpp puts it in
// place.
#pragma once

#include <span>
#include <string>

#include "fairway/base/frame.hpp"
#include "fairway/simulate/flight.hpp"
#include "fairway/simulate/flight_measures.hpp"

namespace fairway {

/// One line per start: `x_m,y_m,heading_rad,outcome,time_s,length_m,flown_m,reversals,turned_rad`
/// and, when the flights were followed along a path, `after,after_s,joined_s,laps,on_path_share,
/// distance_mean_m,distance_worst_m,heading_difference_worst_rad`, empty where it does
/// not apply. At the end `mode`, the one that the flight began in, when the plan has modes. Throws
/// PreconditionViolation when the lengths differ.
[[nodiscard]] std::string outcomes_csv(std::span<const State> starts,
                                       std::span<const FlightResult> results,
                                       std::span<const FlightMeasures> measures, bool followed,
                                       bool has_modes = false);

/// `flight,time_s,x_m,y_m,heading_rad,curvature_per_m,final_leg`: a line at each end of every piece
/// and at least every `step_m` between; flight counts from 0; the curvature is that of the piece;
/// final_leg is 1 on the leg to the goal's heading, which follows the flight, and 0 before it. At
/// the end `mode`, by whose commands the piece is flown, when the plan has modes; empty on the leg.
[[nodiscard]] std::string trajectories_csv(std::span<const Flight> flights, double speed_mps,
                                           double step_m, bool has_modes = false);

/// A FeatureCollection (RFC 7946): per flight a LineString (a Point when it does not move) with the
/// properties flight, outcome, time_s, length_m (null when trapped); when the flight was followed
/// beyond its first goal cell, after, after_s and after_length_m; and, when the goal has a heading
/// and the flight reaches, final_leg. After all of them, per final leg a LineString with
/// the properties flight, final_leg, word, time_s, length_m. A line across the antimeridian is a
/// MultiLineString, cut there. Arcs become chords of at most `step_m`. Without `lon_lat_of`
/// coordinates are metres and a member `note` says so.
[[nodiscard]] std::string flights_geojson(std::span<const Flight> flights, double step_m,
                                          const LonLatOf& lon_lat_of = {});

}  // namespace fairway
