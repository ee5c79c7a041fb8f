#include "fairway/identify/commands_in_force.hpp"

#include <algorithm>
#include <cmath>

namespace fairway {

CommandsInForce::CommandsInForce(const FlownTrack& track, const VehicleContract& contract)
    : track_(track), error_m_(contract.command_error_m), look_ahead_m_(contract.look_ahead_m) {}

Vec2 CommandsInForce::ahead_of(Vec2 place_m, double course_rad) const {
  return place_m + look_ahead_m_ * Vec2{std::cos(course_rad), std::sin(course_rad)};
}

void CommandsInForce::look_back_from(std::size_t sample, double aside_m) {
  given_.clear();
  // A place asked for is at most this far from the motion; the way there may be half a circle.
  const double most_m = 0.5 * pi * (error_m_ + look_ahead_m_ + aside_m);
  const auto is_too_far = [&](std::size_t s) {
    return track_.way_m[sample] - track_.way_m[s] > most_m;
  };
  // Of a command's places the last is the nearest: one for each run.
  for (std::size_t run = track_.run_of[sample] + 1; run-- > 0;) {
    const std::size_t s = std::min(sample, track_.runs[run].last);
    if (is_too_far(s)) return;
    given_.push_back(
        {ahead_of(track_.place_m[s], track_.course_rad[s]), track_.runs[run].command_rad});
  }
  if (!is_too_far(0)) {
    given_.push_back({ahead_of(track_.place_m[0], track_.course_rad[0]), 0.0, true});
  }
}

void CommandsInForce::near(Vec2 place_m, double course_rad) {
  const Vec2 ahead = look_ahead_m_ == 0.0 ? place_m : ahead_of(place_m, course_rad);
  commands_rad_.clear();
  any_command_ = false;
  const double error2 = error_m_ * error_m_;
  for (const Given& given : given_) {
    if (norm2(given.place_m - ahead) > error2) continue;
    any_command_ = any_command_ || given.is_first;
    if (std::find(commands_rad_.begin(), commands_rad_.end(), given.command_rad) ==
        commands_rad_.end()) {
      commands_rad_.push_back(given.command_rad);
    }
  }
}

TurnChoices turn_choices(const CommandsInForce& commands, const TurnStep& step,
                         const VehicleContract& contract, double course_rad, HeldSide held) {
  if (commands.any_command()) return {{step.free(), HeldSide::none}};
  TurnRange ahead;
  bool any_behind = false;
  bool left_is_possible = held == HeldSide::left;
  bool right_is_possible = held == HeldSide::right;
  for (const double command_rad : commands.commands_rad()) {
    const double off_rad = std::remainder(command_rad - course_rad, two_pi);
    if (std::abs(off_rad) <= contract.hold_side_rad) {
      ahead.hold(step.towards(off_rad));
      continue;
    }
    any_behind = true;
    const bool either = std::abs(off_rad) >= pi - contract.side_uncertain_rad;
    left_is_possible = left_is_possible || (held == HeldSide::none && (either || off_rad > 0.0));
    right_is_possible = right_is_possible || (held == HeldSide::none && (either || off_rad < 0.0));
  }
  TurnChoices choices;
  if (!any_behind) {
    if (!ahead.is_empty()) choices.push_back({ahead, HeldSide::none});
    return choices;
  }
  for (const HeldSide side : {HeldSide::left, HeldSide::right}) {
    if (side == HeldSide::left ? !left_is_possible : !right_is_possible) continue;
    TurnRange turn = ahead;
    for (const double command_rad : commands.commands_rad()) {
      const double off_rad = std::remainder(command_rad - course_rad, two_pi);
      if (std::abs(off_rad) > contract.hold_side_rad) turn.hold(step.to_side(off_rad, side));
    }
    choices.push_back({turn, side});
    // A command ahead that is in force for an instant makes the side forgotten.
    if (!ahead.is_empty()) choices.push_back({turn, HeldSide::none});
  }
  return choices;
}

}  // namespace fairway
