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
    given_.push_back({ahead_of(track_.place_m[s], track_.course[s]),
                      {track_.runs[run].command, static_cast<std::uint32_t>(run)}});
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
    const auto is_same = [&](const CommandInForce& c) { return c.command == given.order.command; };
    if (std::any_of(commands_.begin(), commands_.end(), is_same)) continue;
    commands_.push_back(given.order);
  }
}

namespace {

/// Whether a turn to a command that lies `off_rad` behind may go to this side.
bool may_turn(TurnSide side, const CommandInForce& c, double off_rad, SideRule rule, HeldSide held,
              double side_uncertain_rad) {
  if (held.side == side) return true;
  const bool is_held =
      held.side != TurnSide::none && (rule == SideRule::contract || held.run == c.run);
  if (is_held) return false;
  if (std::abs(off_rad) >= pi - side_uncertain_rad) return true;
  return (off_rad > 0.0) == (side == TurnSide::left);
}

}  // namespace

void find_turn_choices(const CommandsInForce& commands, const TurnStep& step,
                       const VehicleContract& contract, SideRule rule, Heading course,
                       HeldSide held, TurnChoices& choices) {
  choices.clear();
  if (commands.any_command()) {
    choices.push_back({step.free(), {}});
    return;
  }
  TurnRange ahead;
  for (const CommandInForce& c : commands.commands()) {
    const double off_rad = course.turn_to(c.command);
    if (std::abs(off_rad) <= contract.hold_side_rad) ahead.hold(step.towards(off_rad));
  }
  TurnRange forgetting =
      ahead;  // a command ahead, in force for an instant, makes the side forgotten
  for (const TurnSide side : {TurnSide::left, TurnSide::right}) {
    TurnChoice choice{ahead, {}};
    for (const CommandInForce& c : commands.commands()) {
      const double off_rad = course.turn_to(c.command);
      if (std::abs(off_rad) <= contract.hold_side_rad ||
          !may_turn(side, c, off_rad, rule, held, contract.side_uncertain_rad)) {
        continue;
      }
      choice.turn.hold(step.to_side(off_rad, side));
      choice.held = {side, c.run};  // the oldest: what comes later may be turned to anew
    }
    if (choice.held.side == TurnSide::none) continue;
    choices.push_back(choice);
    forgetting.hold(choice.turn);
  }
  if (!ahead.is_empty()) choices.push_back({forgetting, {}});
}

}  // namespace fairway
