// Which commands of a log may be in force for a motion near it, and the turns that they allow.
#pragma once

#include <cstddef>
#include <vector>

#include "fairway/identify/flown_track.hpp"
#include "fairway/identify/turn_range.hpp"
#include "fairway/vehicle/contract.hpp"

namespace fairway {

/// First look_back_from a sample, then ask near() places, then read.
class CommandsInForce {
 public:
  CommandsInForce(const FlownTrack& track, const VehicleContract& contract);

  /// The commands given up to this sample that may be in force within `aside_m` of the track.
  void look_back_from(std::size_t sample, double aside_m);
  /// Of these, the ones in force for a motion at a place on a course.
  void near(Vec2 place_m, double course_rad);

  const std::vector<double>& commands_rad() const { return commands_rad_; }
  /// A command given before the log began may be in force, too.
  bool any_command() const { return any_command_; }

 private:
  struct Given {
    Vec2 place_m;  ///< that the command was asked for
    double command_rad = 0.0;
    bool is_first = false;  ///< of the log
  };
  Vec2 ahead_of(Vec2 place_m, double course_rad) const;

  const FlownTrack& track_;
  double error_m_;
  double look_ahead_m_;
  std::vector<Given> given_;
  std::vector<double> commands_rad_;
  bool any_command_ = false;
};

struct TurnChoice {
  TurnRange turn;
  HeldSide side = HeldSide::none;  ///< held from then on
};

using TurnChoices = std::vector<TurnChoice>;

/// What a motion may do over a step: one choice for each side that may be held.
[[nodiscard]] TurnChoices turn_choices(const CommandsInForce& commands, const TurnStep& step,
                                       const VehicleContract& contract, double course_rad,
                                       HeldSide held);

}  // namespace fairway
