// States of a plan in degrees, and back: latitude, longitude, and the course over ground from true
// north. In a projected system, and away from the reference of a tangent plane, true north is not
// quite +y; here it is where the meridian through the state's place leads.
//
// Properties that always hold: state_of(degrees_of(s)) is s to 1e-6 m and 1e-8 rad on maps as large
// as Fairway takes; courses that are written are in [0, 360).
#pragma once

#include <string>

#include "fairway/base/frame.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/map/frame_from_degrees.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// For one thread at a time.
class EarthFrame {
 public:
  /// Throws InputError{where, ...} when the frame has no place on Earth, or one that PROJ does not
  /// understand.
  EarthFrame(const Frame& frame, const std::string& where);

  /// Throws InputError{where, ...} for a place that the frame's system does not reach, or that lies
  /// more than tangent_plane_limit_m from the frame's reference.
  [[nodiscard]] State state_of(const EarthState& state, const std::string& where) const;
  [[nodiscard]] EarthState degrees_of(const State& state) const;

 private:
  [[nodiscard]] Heading north_at(const LonLat& place, const std::string& where) const;

  std::string where_;
  bool is_plane_;
  FrameFromDegrees to_metres_;
  LonLatOf to_degrees_;
};

/// "47.3980012, 8.5459995, course 90.0 deg": to the centimetre and to a tenth of a degree.
[[nodiscard]] std::string earth_text(const EarthState& state);

/// A place as users write it, "[47.3980012, 8.5459995]", in so many decimals of degrees.
[[nodiscard]] std::string lat_lon_text(const LonLat& place, int decimals);

}  // namespace fairway
