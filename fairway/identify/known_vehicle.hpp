// A contract from what an engineer knows of the vehicle, without a flight.
#pragma once

#include <cstdint>
#include <optional>

#include "fairway/identify/explained_contract.hpp"

namespace fairway {

/// What the autopilot holds: the course over ground, or the heading of the nose.
enum class HeldDirection : std::uint8_t { course, heading };

struct KnownVehicle {
  double airspeed_mps = 10.0;  ///< for a vehicle on the ground or on water: its speed
  // One of the three gives the turning radius in still air.
  std::optional<double> bank_limit_rad;
  std::optional<double> turn_rate_radps;
  std::optional<double> turn_radius_m;
  std::optional<double>
      bank_lag_s;  ///< time constant of the roll into a turn; none: it does not roll
  double wind_mps = 0.0;
  double delay_s = 0.0;           ///< from a place to the command that answers it, worst case
  double control_period_s = 0.0;  ///< between two commands
  double position_error_m = 0.0;  ///< worst case
  double heading_error_rad = 0.0174532925199433;  ///< of sensor and control, worst case
  double radius_spread = 0.1;  ///< the radius in still air may be this share more or less
  double speed_spread = 0.05;  ///< the same for the speed
  HeldDirection holds = HeldDirection::course;
};

/// Rounded outwards to three digits. Wind: the curvature of a turn of fixed bank, seen over ground
/// (over_ground() in vehicle/contract.hpp). `wind_mps` is below the least speed, exactly one of the
/// three turn sizes is given, and everything is finite.
[[nodiscard]] ExplainedContract contract_of(const KnownVehicle& vehicle);

/// The turning radius in still air: v^2 / (g tan bank), v / rate, or as given.
[[nodiscard]] double still_air_radius_m(const KnownVehicle& vehicle);

}  // namespace fairway
