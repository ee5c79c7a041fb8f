// Keeps the side of a turn (vehicle/contract.hpp, rule 3; docs/model.md, "Under a contract"), for
// vehicles whose autopilot turns to the shorter side and remembers nothing.
//
// A command that lies farther behind than the contract's hold_side_rad is handed out as one that
// lies at most a quarter turn from the course, to the side first taken: whichever side is shorter
// for the command itself, the autopilot goes on turning to the same. As soon as the command in
// force is nearer, it is handed out as it is, and the side is forgotten.
//
// No heap, no exceptions; one object for one vehicle.
#pragma once

#include <cmath>
#include <limits>

#include "fairway/base/heading.hpp"

namespace fairway {

class TurnSide {
 public:
  /// Of the contract, in (0, pi].
  explicit TurnSide(double hold_side_rad = 0.5 * pi) noexcept : hold_side_rad_(hold_side_rad) {}

  /// What to hand to the autopilot, radians in (-pi, pi], for the command in force and the course.
  /// If one of them is not finite: NaN, and what was held stays held.
  double keep(double command_rad, double course_rad) noexcept {
    if (!std::isfinite(command_rad) || !std::isfinite(course_rad)) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const Heading command = Heading::from_rad(command_rad);
    const double turn_rad = Heading::from_rad(course_rad).turn_to(command);
    if (std::abs(turn_rad) <= hold_side_rad_) {
      held_ = 0;
      return command.rad();
    }
    if (held_ == 0) held_ = turn_rad > 0.0 ? 1 : -1;
    const double away_rad = std::fmin(hold_side_rad_, 0.5 * pi);
    return Heading::from_rad(course_rad + held_ * away_rad).rad();
  }

  /// 1: left, -1: right, 0: none is held.
  int held() const noexcept { return held_; }

 private:
  double hold_side_rad_;
  int held_ = 0;
};

}  // namespace fairway
