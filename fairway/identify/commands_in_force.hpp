// Which commands of a log may be in force for a motion near it, and the turns that they allow.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fairway/identify/flown_track.hpp"
#include "fairway/identify/turn_range.hpp"
#include "fairway/vehicle/contract.hpp"

namespace fairway {

/// How long the side of a turn to a command behind is kept.
enum class SideRule : std::uint8_t {
  each_command,  ///< at least until another command is in force: the path of commands keeps the
                 ///< contract's rule
  contract       ///< as the contract says: for as long as any command in force is behind
};

/// The side taken, and the command (its run) it was taken for.
struct HeldSide {
  TurnSide side = TurnSide::none;
  std::uint32_t run = 0;
};

struct CommandInForce {
  Heading command;
  std::uint32_t run = 0;
};

/// First look_back_from a sample, then ask near() places, then read.
class CommandsInForce {
 public:
  CommandsInForce(const FlownTrack& track, const VehicleContract& contract);

  /// The commands given up to this sample that may be in force within `aside_m` of the track.
  void look_back_from(std::size_t sample, double aside_m);
  /// Of these, the ones in force for a motion at a place on a course.
  void near(Vec2 place_m, Heading course);

  const std::vector<CommandInForce>& commands() const { return commands_; }
  /// A command given before the log began may be in force, too.
  bool any_command() const { return any_command_; }

 private:
  struct Given {
    Vec2 place_m;  ///< that the command was asked for
    CommandInForce order;
    bool is_first = false;  ///< of the log
  };
  Vec2 ahead_of(Vec2 place_m, Heading course) const;

  const FlownTrack& track_;
  double error_m_;
  double look_ahead_m_;
  std::vector<Given> given_;
  std::vector<CommandInForce> commands_;  ///< the newest first
  bool any_command_ = false;
};

struct TurnChoice {
  TurnRange turn;
  HeldSide held;  ///< from then on
};

using TurnChoices = std::vector<TurnChoice>;

/// Fills `choices` with what a motion may do over a step: one for each side that may be held.
void find_turn_choices(const CommandsInForce& commands, const TurnStep& step,
                       const VehicleContract& contract, SideRule rule, Heading course,
                       HeldSide held, TurnChoices& choices);

}  // namespace fairway
