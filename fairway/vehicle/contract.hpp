// What a real vehicle keeps: how far it may stray, at every instant, from the model that obeys at
// once and knows its state exactly (docs/model.md, "Under a contract").
//
// At every instant, with p the true position and h the true course:
//   1. The command in force is that of some position within `command_error_m` of p (or of the point
//      `look_ahead_m` ahead of p), give or take `heading_error_rad`; both errors change as they
//      like. A cell without a command has that of the nearest cell with one (filled_commands).
//   2. While h differs from the command in force, the vehicle turns towards it, with a radius
//      anywhere in `turn_radius_m`. Within the heading error of such a cell's command it may do
//      anything that stays within, but never turn more sharply than the least radius.
//   3. It turns through the smaller angle. When the command lies farther than `hold_side_rad` from
//      the heading, the side first taken is kept for as long as it does. Within
//      `side_uncertain_rad` of opposite either side may be taken.
//   4. Its speed over ground is in `speed_mps`. Only bounds of time depend on it.
#pragma once

#include <cmath>

#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

struct SizeRange {
  double least = 0.0;
  double most = 0.0;
  friend constexpr bool operator==(const SizeRange&, const SizeRange&) = default;
};

struct VehicleContract {
  double command_error_m = 0.0;
  double look_ahead_m = 0.0;
  double heading_error_rad = 0.0;
  SizeRange turn_radius_m;
  SizeRange speed_mps;
  double hold_side_rad = 1.5707963267948966;
  double side_uncertain_rad = 0.0;
  double wind_mps = 0.0;  ///< radius and speed are then those through the air

  friend constexpr bool operator==(const VehicleContract&, const VehicleContract&) = default;

  /// That of the exact vehicle, which keeps every contract that holds its radius and speed.
  static constexpr VehicleContract of(const Vehicle& vehicle) {
    VehicleContract exact;
    exact.turn_radius_m = {vehicle.turn_radius_m, vehicle.turn_radius_m};
    exact.speed_mps = {vehicle.speed_mps, vehicle.speed_mps};
    return exact;
  }
};

/// Whether all that keeps `tight` also keeps `wide`. (What is proved under `wide` then holds under
/// `tight`.)
constexpr bool is_within(const VehicleContract& tight, const VehicleContract& wide) {
  return tight.command_error_m <= wide.command_error_m && tight.look_ahead_m == wide.look_ahead_m &&
         tight.heading_error_rad <= wide.heading_error_rad &&
         tight.turn_radius_m.least >= wide.turn_radius_m.least &&
         tight.turn_radius_m.most <= wide.turn_radius_m.most &&
         tight.speed_mps.least >= wide.speed_mps.least &&
         tight.speed_mps.most <= wide.speed_mps.most && tight.hold_side_rad == wide.hold_side_rad &&
         tight.side_uncertain_rad <= wide.side_uncertain_rad && tight.wind_mps <= wide.wind_mps;
}

/// The same motions over ground, without look-ahead and wind: all that keeps `contract` keeps it,
/// too, so what is proved of it holds for `contract`. wind_mps is less than the least speed.
///
/// A point ahead is within look_ahead_m of the vehicle. Of a circle of radius r flown through air
/// that moves at W, the curvature over ground is v (s^2 + v^2 - W^2) / (2 r s^3) at speed s over
/// ground: from 1 / (r (1 + w)^2) at s = v + W to 1 / (r (1 - w)^2) at s = v - W, with w = W / v.
constexpr VehicleContract over_ground(const VehicleContract& contract) {
  VehicleContract wider = contract;
  wider.command_error_m += contract.look_ahead_m;
  wider.look_ahead_m = 0.0;
  if (contract.wind_mps == 0.0) return wider;
  const double w = contract.wind_mps / contract.speed_mps.least;
  wider.turn_radius_m.least *= (1.0 - w) * (1.0 - w);
  wider.turn_radius_m.most *= (1.0 + w) * (1.0 + w);
  wider.speed_mps.least -= contract.wind_mps;
  wider.speed_mps.most += contract.wind_mps;
  wider.wind_mps = 0.0;
  return wider;
}

}  // namespace fairway
