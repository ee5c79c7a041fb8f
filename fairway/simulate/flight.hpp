// One flight of a vehicle under a plan.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// What ends a flight, by what comes first (docs/model.md). Each has the number of its Verdict, so
/// that outcomes and verdicts can be compared (run/verification.cpp asserts it); none has 0.
/// `hold` is trapped by another name, from where the mission is out of reach and the plan holds.
enum class Outcome : std::uint8_t { reach = 1, collide = 2, leave = 3, trapped = 4, hold = 6 };

inline constexpr std::array outcomes_in_order{Outcome::reach, Outcome::hold, Outcome::collide,
                                              Outcome::leave, Outcome::trapped};
/// Not every plan has flights that hold: lists have them only where some flight does.
constexpr bool is_listed(Outcome outcome, std::size_t count) {
  return count > 0 || outcome != Outcome::hold;
}

/// Arrays that are indexed by an outcome's number have this size; [0] and [5] belong to
/// none.
inline constexpr std::size_t outcome_codes = 7;

/// The name used in files and on screen.
constexpr const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::reach:
      return "reach";
    case Outcome::collide:
      return "collide";
    case Outcome::leave:
      return "leave";
    case Outcome::trapped:
      return "trapped";
    case Outcome::hold:
      return "hold";
  }
  return "";
}

/// Time and length are to the event that ends the flight; +inf when trapped or holding.
struct FlightResult {
  Outcome outcome = Outcome::trapped;
  double time_s = 0.0;
  double length_m = 0.0;
  int mode = 0;  ///< that the flight began in (docs/modes.md)
};

/// How a flight went on that was followed beyond its first goal cell, as those of path missions and
/// about a goal to hold at can be. Not part of the flight's result: an outcome is reach once a goal
/// cell is entered.
enum class After : std::uint8_t {
  none,     ///< not followed, or the flight does not reach
  follow,   ///< flew on for as long as it was followed
  collide,  ///< touched an obstacle cell
  leave,    ///< left the grid
  hold      ///< as follow, about a goal to hold at
};

/// Where each of `After` but none, in this order, is counted or written.
inline constexpr std::array afters_in_order{After::follow, After::hold, After::collide,
                                            After::leave};

/// The name used in files and on screen; empty for none.
constexpr const char* name_of(After after) {
  switch (after) {
    case After::none:
      return "";
    case After::follow:
      return "follow";
    case After::hold:
      return "hold";
    case After::collide:
      return "collide";
    case After::leave:
      return "leave";
  }
  return "";
}

/// Time and length are from the start to where the flight was followed to, or ended.
struct Onward {
  After after = After::none;
  double time_s = 0.0;
  double length_m = 0.0;
  friend bool operator==(const Onward&, const Onward&) = default;
};

/// For how long a flight is followed beyond its first goal cell: until either limit. One of them is
/// finite, both are > 0.
struct FollowLimit {
  double length_m = std::numeric_limits<double>::infinity();  ///< over the ground
  double time_s = std::numeric_limits<double>::infinity();
};

/// How much a flight turns, over all that was flown: to its end or to where it was followed to; a
/// trapped one to where the trap was recognised or the time was up.
struct Turning {
  double length_m = 0.0;        ///< flown, over the ground
  double turned_rad = 0.0;      ///< left and right turns added up, without sign
  std::uint64_t reversals = 0;  ///< left turns after right ones or the other way round, whether or
                                ///< not straight pieces lie between them
  double last_turn = 0.0;       ///< 1 after a left turn, -1 after a right one, 0 before the first

  /// A piece that turns by `turn_rad`, positive to the left.
  void add(double turn_rad, double moved_m) {
    length_m += moved_m;
    if (turn_rad == 0.0) return;
    turned_rad += std::abs(turn_rad);
    if (turn_rad * last_turn < 0.0) ++reversals;
    last_turn = turn_rad > 0.0 ? 1.0 : -1.0;
  }
  friend bool operator==(const Turning&, const Turning&) = default;
};

/// One piece of constant curvature: from `start`, `length_m` long, curvature positive to the left.
struct FlightSegment {
  State start;
  double time_s = 0.0;  ///< at the start of the piece
  double length_m = 0.0;
  double curvature_per_m = 0.0;
  int mode = 0;  ///< by whose commands it is flown (docs/modes.md)
};

/// The state `along_m` after the start of a piece.
inline State state_at(const FlightSegment& piece, double along_m) {
  const Vec2 p = piece.start.position_m;
  const Vec2 u = piece.start.heading.unit();
  const double turned = along_m * piece.curvature_per_m;
  // The chord of the arc: sin(turned / 2) / (turned / 2) of its length, halfway between headings.
  const double half = 0.5 * turned;
  const double chord_m = half == 0.0 ? along_m : along_m * (std::sin(half) / half);
  const double c = std::cos(half);
  const double s = std::sin(half);
  const Vec2 middle{u.x * c - u.y * s, u.x * s + u.y * c};
  return {p + chord_m * middle, Heading::from_rad(piece.start.heading.rad() + turned)};
}

/// How a flight that reached continues, if the goal has a heading.
enum class FinalLegState : std::uint8_t {
  not_asked,  ///< the goal has no heading, or the flight does not reach
  shortest,   ///< by the shortest path, which touches no obstacle
  other,      ///< by another approach that touches none, as the shortest path would
  none_clear  ///< every approach that was tried touches an obstacle: there is no leg
};

/// The name used in files and on screen.
constexpr const char* name_of(FinalLegState state) {
  switch (state) {
    case FinalLegState::not_asked:
      return "not_asked";
    case FinalLegState::shortest:
      return "shortest";
    case FinalLegState::other:
      return "other";
    case FinalLegState::none_clear:
      return "none_clear";
  }
  return "";
}

/// From where a flight entered a goal cell to the goal's pose. Not part of the flight's result: an
/// outcome is reach once a goal cell is entered.
struct FinalLeg {
  FinalLegState state = FinalLegState::not_asked;
  State entry;                          ///< where the flight entered the goal cell
  std::string word;                     ///< "LSL"; "S+LSR": straight on first
  double time_s = 0.0;                  ///< of the leg alone
  double length_m = 0.0;                ///< of the leg alone
  std::vector<FlightSegment> segments;  ///< joined end to end; their time goes on from the flight's
};

struct Flight {
  State start;
  FlightResult result;
  std::vector<FlightSegment> segments;  ///< joined end to end; recorded only when asked for
  FinalLeg final_leg = {};
  Turning turning = {};  ///< of the flight, without its last leg
  Onward onward = {};    ///< when it was followed beyond its first goal cell
};

/// The state in which a recorded flight ended.
inline State end_of(const Flight& flight) {
  return flight.segments.empty()
             ? flight.start
             : state_at(flight.segments.back(), flight.segments.back().length_m);
}

}  // namespace fairway
