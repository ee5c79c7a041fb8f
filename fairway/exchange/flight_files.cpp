#include "fairway/exchange/flight_files.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "fairway/base/error.hpp"

namespace fairway {

namespace {

void append(std::string& text, double value) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  text.append(buffer.data(), end.ptr);
}

void append_fixed(std::string& text, double value, int decimals) {
  std::array<char, 400> buffer;  // the longest double has 309 digits before the point
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::fixed, decimals);
  text.append(buffer.data(), end.ptr);
}

void append_state(std::string& text, const State& state) {
  append(text, state.position_m.x);
  text += ',';
  append(text, state.position_m.y);
  text += ',';
  append(text, state.heading.rad());
}

/// Calls visit(piece, along_m) at both ends of the piece and between, at most `step_m` apart.
template <typename Visit>
void for_steps(const FlightSegment& piece, double step_m, const Visit& visit) {
  const double steps = std::max(1.0, std::ceil(piece.length_m / step_m));
  for (double i = 0.0; i < steps; i += 1.0) visit(piece, piece.length_m * i / steps);
  visit(piece, piece.length_m);
}

/// Degrees if the frame is georeferenced, else metres.
Vec2 coordinates_of(Vec2 p, const LonLatOf& lon_lat_of) {
  if (!lon_lat_of) return p;
  const LonLat place = lon_lat_of(p);
  return {place.longitude_deg, place.latitude_deg};
}

void append_position(std::string& text, Vec2 coordinates, bool degrees) {
  const int decimals = degrees ? 9 : 4;  // 0.1 mm
  text += '[';
  append_fixed(text, coordinates.x, decimals);
  text += ',';
  append_fixed(text, coordinates.y, decimals);
  text += ']';
}

using Line = std::vector<Vec2>;

/// A line in degrees, cut where it crosses the antimeridian (RFC 7946, 3.1.9): two neighbours there
/// are more than half the world apart.
std::vector<Line> cut_at_antimeridian(const Line& line) {
  std::vector<Line> parts(1);
  for (Vec2 next : line) {
    Line& part = parts.back();
    if (part.empty() || std::abs(next.x - part.back().x) <= 180.0) {
      part.push_back(next);
      continue;
    }
    const Vec2 from = part.back();
    const double side = from.x < 0.0 ? -180.0 : 180.0;
    if (next.x == -side) {  // it ends on the antimeridian, which has two names
      part.push_back({side, next.y});
      continue;
    }
    const double to_side = std::abs(side - from.x);
    const double beyond = std::abs(next.x + side);
    const double y = from.y + to_side / (to_side + beyond) * (next.y - from.y);
    if (to_side > 0.0) part.push_back({side, y});
    if (part.size() == 1) part.clear();  // it began on the antimeridian
    if (!part.empty()) parts.emplace_back();
    parts.back() = {{-side, y}, next};
  }
  return parts;
}

void append_lines(std::string& text, const std::vector<Line>& lines, bool degrees) {
  text += lines.size() == 1 ? "{\"type\":\"LineString\",\"coordinates\":"
                            : "{\"type\":\"MultiLineString\",\"coordinates\":[";
  const char* between = "";
  for (const Line& line : lines) {
    text += std::exchange(between, ",");
    const char* before = "[";
    for (const Vec2 p : line) {
      text += std::exchange(before, ",");
      append_position(text, p, degrees);
    }
    text += ']';
  }
  text += lines.size() == 1 ? "}" : "]}";
}

/// A line along the pieces, or a Point when there are none.
void append_geometry(std::string& text, const State& start, std::span<const FlightSegment> segments,
                     double step_m, const LonLatOf& lon_lat_of) {
  const bool degrees = static_cast<bool>(lon_lat_of);
  if (segments.empty()) {
    text += "{\"type\":\"Point\",\"coordinates\":";
    append_position(text, coordinates_of(start.position_m, lon_lat_of), degrees);
    text += '}';
    return;
  }
  Line line{coordinates_of(segments.front().start.position_m, lon_lat_of)};
  for (const FlightSegment& piece : segments) {
    // A straight line needs only its end.
    const double chord_m = piece.curvature_per_m == 0.0 ? piece.length_m : step_m;
    for_steps(piece, chord_m, [&](const FlightSegment& p, double along_m) {
      if (along_m == 0.0) return;
      line.push_back(coordinates_of(state_at(p, along_m).position_m, lon_lat_of));
    });
  }
  append_lines(text, degrees ? cut_at_antimeridian(line) : std::vector<Line>{line}, degrees);
}

void append_or_null(std::string& text, double value) {
  if (std::isfinite(value)) {
    append(text, value);
  } else {
    text += "null";
  }
}

}  // namespace

namespace {

void append_following(std::string& text, const FlightMeasures& measures) {
  const PathFollowing& following = measures.following;
  text += ',';
  text += name_of(measures.onward.after);
  text += ',';
  if (measures.onward.after != After::none) append(text, measures.onward.time_s);
  for (const double value :
       {following.joined_s, following.laps, following.on_path_share, following.distance_mean_m,
        following.distance_worst_m, following.heading_worst_rad}) {
    text += ',';
    if (std::isfinite(following.joined_s)) append(text, value);
  }
}

}  // namespace

std::string outcomes_csv(std::span<const State> starts, std::span<const FlightResult> results,
                         std::span<const FlightMeasures> measures, bool followed, bool has_modes) {
  require(starts.size() == results.size() && starts.size() == measures.size(),
          "one result and one measure per start");
  std::string text = "x_m,y_m,heading_rad,outcome,time_s,length_m,flown_m,reversals,turned_rad";
  if (followed) {
    text +=
        ",after,after_s,joined_s,laps,on_path_share,distance_mean_m,distance_worst_m"
        ",heading_difference_worst_rad";
  }
  if (has_modes) text += ",mode";
  text += '\n';
  for (std::size_t i = 0; i < starts.size(); ++i) {
    append_state(text, starts[i]);
    text += ',';
    text += name_of(results[i].outcome);
    for (const double value : {results[i].time_s, results[i].length_m}) {
      text += ',';
      append(text, value);
    }
    const Turning& turning = measures[i].turning;
    text += ',';
    append(text, turning.length_m);
    text += ',' + std::to_string(turning.reversals) + ',';
    append(text, turning.turned_rad);
    if (followed) append_following(text, measures[i]);
    if (has_modes) text += ',' + std::to_string(results[i].mode);
    text += '\n';
  }
  return text;
}

std::string trajectories_csv(std::span<const Flight> flights, double speed_mps, double step_m,
                             bool has_modes) {
  require(speed_mps > 0.0 && step_m > 0.0, "speed and step are positive");
  std::string text = "flight,time_s,x_m,y_m,heading_rad,curvature_per_m,final_leg";
  text += has_modes ? ",mode\n" : "\n";
  for (std::size_t i = 0; i < flights.size(); ++i) {
    const std::string number = std::to_string(i) + ',';
    const auto add = [&](std::span<const FlightSegment> segments, bool final_leg) {
      for (const FlightSegment& piece : segments) {
        std::string end = final_leg ? ",1" : ",0";
        if (has_modes) end += final_leg ? "," : ',' + std::to_string(piece.mode);
        end += '\n';
        for_steps(piece, step_m, [&](const FlightSegment& p, double along_m) {
          text += number;
          append(text, p.time_s + along_m / speed_mps);
          text += ',';
          append_state(text, state_at(p, along_m));
          text += ',';
          append(text, p.curvature_per_m);
          text += end;
        });
      }
    };
    add(flights[i].segments, false);
    add(flights[i].final_leg.segments, true);
  }
  return text;
}

namespace {

void append_flight(std::string& text, std::size_t number, const Flight& flight, double step_m,
                   const LonLatOf& lon_lat_of) {
  text += "{\"type\":\"Feature\",\"properties\":{\"flight\":" + std::to_string(number);
  text += ",\"outcome\":\"";
  text += name_of(flight.result.outcome);
  text += "\",\"time_s\":";
  append_or_null(text, flight.result.time_s);
  text += ",\"length_m\":";
  append_or_null(text, flight.result.length_m);
  if (flight.onward.after != After::none) {
    text += ",\"after\":\"";
    text += name_of(flight.onward.after);
    text += "\",\"after_s\":";
    append(text, flight.onward.time_s);
    text += ",\"after_length_m\":";
    append(text, flight.onward.length_m);
  }
  if (flight.final_leg.state != FinalLegState::not_asked) {
    text += ",\"final_leg\":\"";
    text += name_of(flight.final_leg.state);
    text += '"';
  }
  text += "},\"geometry\":";
  append_geometry(text, flight.start, flight.segments, step_m, lon_lat_of);
  text += '}';
}

void append_final_leg(std::string& text, std::size_t number, const Flight& flight, double step_m,
                      const LonLatOf& lon_lat_of) {
  const FinalLeg& leg = flight.final_leg;
  text += "{\"type\":\"Feature\",\"properties\":{\"flight\":" + std::to_string(number);
  text += ",\"final_leg\":\"";
  text += name_of(leg.state);
  text += "\",\"word\":\"" + leg.word + "\",\"time_s\":";
  append(text, leg.time_s);
  text += ",\"length_m\":";
  append(text, leg.length_m);
  text += "},\"geometry\":";
  append_geometry(text, leg.entry, leg.segments, step_m, lon_lat_of);
  text += '}';
}

}  // namespace

std::string flights_geojson(std::span<const Flight> flights, double step_m,
                            const LonLatOf& lon_lat_of) {
  require(step_m > 0.0, "a step is positive");
  std::string text = "{\"type\":\"FeatureCollection\",";
  if (!lon_lat_of) {
    text += "\"note\":\"coordinates are metres in the map's frame, not longitude and latitude\",";
  }
  text += "\"features\":[";
  const char* before = "\n";
  for (std::size_t i = 0; i < flights.size(); ++i) {
    text += std::exchange(before, ",\n");
    append_flight(text, i, flights[i], step_m, lon_lat_of);
  }
  for (std::size_t i = 0; i < flights.size(); ++i) {
    if (flights[i].final_leg.segments.empty()) continue;
    text += std::exchange(before, ",\n");
    append_final_leg(text, i, flights[i], step_m, lon_lat_of);
  }
  text += "\n]}\n";
  return text;
}

}  // namespace fairway
