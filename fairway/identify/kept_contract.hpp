// Whether a flight keeps a vehicle contract: whether some motion of the contract stays within the
// tracking distance of the whole log. Motions are compared, not instants: a bank that rolls through
// level turns nothing for a moment, and the vehicle is still near a motion that turns.
//
// "Kept" comes with a motion that shows it. "Not kept" means that the search found none
// (nearest_motion.hpp).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fairway/identify/commands_in_force.hpp"
#include "fairway/identify/flown_track.hpp"
#include "fairway/vehicle/contract.hpp"

namespace fairway {

struct KeptContract {
  bool kept = false;  ///< in place; see wrong_speed
  /// Some motion stays this near to the whole log, metres; infinite: none at any distance, for
  /// beyond command_error_m from the vehicle no command that it was given is in force.
  double needs_m = 0.0;
  /// Where a tracking distance a little smaller than `needs_m` fails: the sample that decides.
  std::size_t worst = 0;
  /// The last sample with a motion within the tracking distance, when it is not kept.
  std::size_t kept_until = 0;
  /// The sample that flies too slowly or too fast for the contract by most, if one does. Places do
  /// not depend on speed: only bounds of time fail.
  std::optional<std::size_t> wrong_speed;
  /// A motion that stays within `needs_m`, one place a sample; where that is infinite, one within
  /// the tracking distance for as long as there is one.
  std::vector<Vec2> motion_m;
};

[[nodiscard]] KeptContract kept_contract(const FlownTrack& track, const VehicleContract& contract,
                                         double tracking_m,
                                         SideRule sides = SideRule::each_command);

}  // namespace fairway
