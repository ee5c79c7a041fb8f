#include "fairway/identify/commands_in_force.hpp"

#include <algorithm>
#include <cmath>

namespace fairway {

CommandsInForce::CommandsInForce(const FlownTrack& track, const VehicleContract& contract)
    : track_(track), error_m_(contract.command_error_m), look_ahead_m_(contract.look_ahead_m) {}

Vec2 CommandsInForce::ahead_of(Vec2 place_m, Heading course) const {
  return look_ahead_m_ == 0.0 ? place_m : place_m + look_ahead_m_ * course.unit();
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
    given_.push_back({ahead_of(track_.place_m[s], track_.course[s]), track_.runs[run].command});
  }
  if (!is_too_far(0)) {
    given_.push_back({ahead_of(track_.place_m[0], track_.course[0]), {}, true});
  }
}

void CommandsInForce::near(Vec2 place_m, Heading course) {
  const Vec2 ahead = ahead_of(place_m, course);
  commands_.clear();
  any_command_ = false;
  const double error2 = error_m_ * error_m_;
  for (const Given& given : given_) {
    if (norm2(given.place_m - ahead) > error2) continue;
    any_command_ = any_command_ || given.is_first;
    if (std::find(commands_.begin(), commands_.end(), given.command) == commands_.end()) {
      commands_.push_back(given.command);
    }
  }
}

void find_turn_choices(const CommandsInForce& commands, const TurnStep& step,
                       const VehicleContract& contract, Heading course, HeldSide held,
                       TurnChoices& choices) {
  choices.clear();
  if (commands.any_command()) {
    choices.push_back({step.free(), HeldSide::none});
    return;
  }
  TurnRange ahead;
  bool any_behind = false;
  bool left_is_possible = held == HeldSide::left;
  bool right_is_possible = held == HeldSide::right;
  for (const Heading command : commands.commands()) {
    const double off_rad = course.turn_to(command);
    if (std::abs(off_rad) <= contract.hold_side_rad) {
      ahead.hold(step.towards(off_rad));
      continue;
    }
    any_behind = true;
    const bool either = std::abs(off_rad) >= pi - contract.side_uncertain_rad;
    left_is_possible = left_is_possible || (held == HeldSide::none && (either || off_rad > 0.0));
    right_is_possible = right_is_possible || (held == HeldSide::none && (either || off_rad < 0.0));
  }
  if (!any_behind) {
    if (!ahead.is_empty()) choices.push_back({ahead, HeldSide::none});
    return;
  }
  TurnRange forgetting =
      ahead;  // a command ahead, in force for an instant, makes the side forgotten
  for (const HeldSide side : {HeldSide::left, HeldSide::right}) {
    if (side == HeldSide::left ? !left_is_possible : !right_is_possible) continue;
    TurnRange turn = ahead;
    for (const Heading command : commands.commands()) {
      const double off_rad = course.turn_to(command);
      if (std::abs(off_rad) > contract.hold_side_rad) turn.hold(step.to_side(off_rad, side));
    }
    choices.push_back({turn, side});
    forgetting.hold(turn);
  }
  if (!ahead.is_empty()) choices.push_back({forgetting, HeldSide::none});
}

}  // namespace fairway
