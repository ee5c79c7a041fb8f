// A motion that keeps a vehicle contract and stays near a flown track, if one can be found.
//
// A beam search over time. Its states are motions so far: place, course, and the side that is held.
// At each sample the commands that may be in force are those that the log gave from then back to
// where the vehicle was more than `command_error_m` from the motion (before the log began: any),
// both seen `look_ahead_m` ahead. A command is never obeyed before it is given.
// Since the command in force may change at any instant, the turn over a step may be anything
// between the extremes of what the commands allow (the limit of ever faster changes). The speed is
// that of the track, somewhat faster where the motion is behind and slower where it is ahead:
// places do not depend on it. Motions alike in place and course are one; the beam keeps those
// nearest to the track.
//
// What it returns keeps the contract, so "found" is a proof up to the length of the steps. That
// nothing is found proves nothing: another motion may exist. Deterministic.
#pragma once

#include <cstddef>
#include <vector>

#include "fairway/identify/commands_in_force.hpp"
#include "fairway/identify/flown_track.hpp"
#include "fairway/vehicle/contract.hpp"

namespace fairway {

struct NearestMotion {
  bool stays = false;         ///< to the end of the track
  std::size_t reached = 0;    ///< the last sample with a motion within the limit
  double farthest_m = 0.0;    ///< of the motion from the track
  std::size_t farthest = 0;   ///< the sample where that is
  std::vector<Vec2> place_m;  ///< the motion at each sample up to `reached`, when asked for
};

struct MotionSearch {
  double limit_m = 1.0;  ///< distance from the track, above 0
  SideRule sides = SideRule::each_command;
  bool wants_places = false;
  std::size_t most_states = 96;
};

[[nodiscard]] NearestMotion nearest_motion(const FlownTrack& track, const VehicleContract& contract,
                                           const MotionSearch& search);

}  // namespace fairway
