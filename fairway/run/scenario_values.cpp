#include "fairway/run/scenario_values.hpp"

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "fairway/base/heading.hpp"
#include "fairway/base/number_csv.hpp"

namespace fairway {

using nlohmann::json;

void take(const TomlValue& v, double& x) { x = v.number(); }
void take(const TomlValue& v, std::uint64_t& x) { x = v.whole_number(); }
void take(const TomlValue& v, bool& x) { x = v.flag(); }
void take(const TomlValue& v, Vec2& x) { x = v.pair(); }
void take(const TomlValue& v, std::filesystem::path& x) {
  x = v.text();
  if (x.empty()) v.refuse("the name of a file");
}
void take(const TomlValue& v, GeodeticPoint& x) {
  const Vec2 pair = v.pair();
  if (pair.x < -90.0 || pair.x > 90.0) v.refuse("[latitude, longitude], latitude in [-90, 90]");
  x = {pair.x, pair.y};
}
void take(const TomlValue& v, std::vector<State>& x) {
  x.clear();
  for (const auto& row : v.rows(3)) {
    if (std::abs(row[2]) > most_heading_rad) {
      const bool may_be_degrees = std::abs(row[2]) <= 360.0;
      v.refuse(fmt::format(
          "headings in radians from -7 to 7 (not {}{})", row[2],
          may_be_degrees ? fmt::format("; {} degrees are {:.6g}", row[2], row[2] * (pi / 180.0))
                         : std::string()));
    }
    x.push_back({{row[0], row[1]}, Heading::from_rad(row[2])});
  }
}
void take(const TomlValue& v, std::vector<EarthState>& x) {
  x.clear();
  for (const auto& row : v.rows(3)) {
    if (std::abs(row[0]) > 90.0 || std::abs(row[1]) > 180.0) {
      v.refuse(
          "[latitude, longitude, course] with latitude in [-90, 90] and longitude in "
          "[-180, 180]");
    }
    x.push_back({row[0], row[1], row[2]});
  }
}

json shown(double x) { return x; }
json shown(std::uint64_t x) { return x; }
json shown(bool x) { return x; }
json shown(Vec2 x) { return {x.x, x.y}; }
json shown(const GeodeticPoint& x) { return {x.latitude_deg, x.longitude_deg}; }
json shown(const std::filesystem::path& x) { return x.empty() ? json() : json(x.string()); }
json shown(const std::vector<State>& states) {
  json rows = json::array();
  for (const State& s : states) rows.push_back({s.position_m.x, s.position_m.y, s.heading.rad()});
  return rows;
}
json shown(const std::vector<EarthState>& states) {
  json rows = json::array();
  for (const EarthState& s : states)
    rows.push_back({s.latitude_deg, s.longitude_deg, s.course_deg});
  return rows;
}

}  // namespace fairway
