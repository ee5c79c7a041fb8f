// How far a motion may turn over a step under a vehicle contract, given the commands in force.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "fairway/base/heading.hpp"
#include "fairway/vehicle/contract.hpp"

namespace fairway {

enum class TurnSide : std::int8_t { right = -1, none = 0, left = 1 };

/// Turns from least to most, radians, positive to the left.
struct TurnRange {
  double least = 1.0;
  double most = -1.0;
  bool is_empty() const { return least > most; }
  void hold(TurnRange other) {
    if (is_empty()) {
      *this = other;
    } else {
      least = std::min(least, other.least);
      most = std::max(most, other.most);
    }
  }
  double nearest_to(double turn_rad) const { return std::clamp(turn_rad, least, most); }
};

/// A step of a motion under a contract.
struct TurnStep {
  double slowest_rad = 0.0;  ///< turned over the step on the widest circle
  double fastest_rad = 0.0;  ///< on the narrowest
  double error_rad = 0.0;    ///< heading_error_rad

  TurnStep(const VehicleContract& contract, double step_m)
      : slowest_rad(step_m / contract.turn_radius_m.most),
        fastest_rad(step_m / contract.turn_radius_m.least),
        error_rad(contract.heading_error_rad) {}

  /// Any command: what may happen where none is known.
  TurnRange free() const { return {-fastest_rad, fastest_rad}; }

  /// For a command that lies `off_rad` to the left of the course, in (-pi, pi]: towards it, until
  /// within the error; there anything that stays within.
  TurnRange towards(double off_rad) const {
    if (std::abs(off_rad) <= error_rad) {
      return {std::max(-fastest_rad, off_rad - error_rad),
              std::min(fastest_rad, off_rad + error_rad)};
    }
    return around(std::abs(off_rad), off_rad > 0.0);
  }
  /// The same to a side, with `left_rad` > error still to turn.
  TurnRange around(double left_rad, bool to_the_left) const {
    const double least = std::min(slowest_rad, left_rad - error_rad);
    const double most = std::min(fastest_rad, left_rad + error_rad);
    return to_the_left ? TurnRange{least, most} : TurnRange{-most, -least};
  }
  TurnRange to_side(double off_rad, TurnSide side) const {
    const bool left = side == TurnSide::left;
    const double ahead_rad = left ? off_rad : -off_rad;
    return around(ahead_rad > 0.0 ? ahead_rad : ahead_rad + two_pi, left);
  }
};

}  // namespace fairway
