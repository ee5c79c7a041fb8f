#include "fairway/map/earth_frame.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/map/degrees_from_frame.hpp"
#include "fairway/map/tangent_plane.hpp"

namespace fairway {
namespace {

const Frame& required_on_earth(const Frame& frame, const std::string& where) {
  if (!frame.is_on_earth()) {
    throw InputError(where,
                     "the map is not georeferenced, so that degrees have no place on it; expected "
                     "metres of the map, and a heading counter-clockwise from +x");
  }
  return frame;
}

}  // namespace

EarthFrame::EarthFrame(const Frame& frame, const std::string& where)
    : where_(where),
      is_plane_(frame.geo.has_value()),
      to_metres_(required_on_earth(frame, where), where),
      to_degrees_(lon_lat_of(frame, where)) {}

Heading EarthFrame::north_at(const LonLat& place, const std::string& where) const {
  constexpr double step_deg = 1e-5;  // a metre
  const auto at = [&](double latitude_deg) {
    return to_metres_.point_m(where, {std::clamp(latitude_deg, -90.0, 90.0), place.longitude_deg});
  };
  return Heading::of(at(place.latitude_deg + step_deg) - at(place.latitude_deg - step_deg));
}

State EarthFrame::state_of(const EarthState& state, const std::string& where) const {
  const Vec2 place_m = to_metres_.point_m(where, {state.latitude_deg, state.longitude_deg});
  if (is_plane_ && !(norm(place_m) <= tangent_plane_limit_m)) {
    throw InputError(
        where, fmt::format("latitude {} longitude {} is more than {} km from the "
                           "map's reference; expected latitude first",
                           decimal_text(state.latitude_deg, 7),
                           decimal_text(state.longitude_deg, 7), tangent_plane_limit_m / 1000.0));
  }
  const Heading north = north_at({state.longitude_deg, state.latitude_deg}, where);
  const double course_rad = std::remainder(state.course_deg, 360.0) * (pi / 180.0);
  return {place_m, Heading::from_rad(north.rad() - course_rad)};
}

EarthState EarthFrame::degrees_of(const State& state) const {
  const LonLat place = to_degrees_(state.position_m);
  double course_deg = state.heading.turn_to(north_at(place, where_)) * (180.0 / pi);
  if (course_deg < 0.0) course_deg += 360.0;
  if (course_deg >= 360.0) course_deg = 0.0;
  return {place.latitude_deg, place.longitude_deg, course_deg};
}

std::string earth_text(const EarthState& state) {
  // 359.96 is 0.0 to a tenth, not 360.0.
  const double course_deg = std::fmod(std::round(10.0 * state.course_deg) / 10.0, 360.0);
  return fmt::format("{}, {}, course {:.1f} deg", decimal_text(state.latitude_deg, 7),
                     decimal_text(state.longitude_deg, 7), course_deg);
}

std::string lat_lon_text(const LonLat& place, int decimals) {
  return fmt::format("[{}, {}]", decimal_text(place.latitude_deg, decimals),
                     decimal_text(place.longitude_deg, decimals));
}

}  // namespace fairway
