// What the contract allows those that turn, and where a cone of headings leaves a part.
#pragma once

#include "check/contract_parts.hpp"
#include "check/shape.hpp"

namespace fairway_check {

/// What a behaviour may remember about the side to which it turns.
struct Memory {
  bool nothing = false;
  bool side = false;  ///< the one it turns to: it is kept while the command is far
  bool any() const { return nothing || side; }
};

/// What is possible in a part for those that turn to one side, over a step of the heading.
struct Choices {
  bool aligns = false;      ///< the heading may be in the arc
  bool goes_on = false;     ///< with `on` in memory
  bool turns_back = false;  ///< with `back` in memory, where the side is then the other one
  bool alternates = false;  ///< may turn back and on again as often as it likes
  Memory on{};
  Memory back{};
};

/// For headings from `start` over `step` rad, as angles in the direction of the turn. `first`: the
/// end of the arc that comes first in that direction. The arc is not loose.
Choices choices_in(double first, double width, double start, double step, Memory memory,
                   const Contract& contract);

/// Headings at which choices may change, as angles from `first` (same sense).
inline constexpr int turning_points = 10;
void find_turning_points(double first, double width, const Contract& contract,
                         double (&found)[turning_points]);

/// Whether all that turn to one side (`turn`: 1 left, -1 right) with headings turn * `clock` over
/// `step` are in the arc, and stay in it.
bool keep_to(const Arc& arc, int turn, double clock, double step, Memory memory,
             const Contract& contract);

/// Whether an aligned behaviour may turn out of the arc, or any command may be in force.
bool is_loose(const Arc& arc, const Contract& contract);

/// The same angle in [0, 2 pi), or just below 0 instead of just below 2 pi.
double around_from(double angle);

/// Headings of [least, most] (less than 180 degrees) that point outwards over a side or along it.
bool point_outwards(int side, double& least, double& most);

/// Where those at `at`, in a part at [0, 1]^2 or just beside it, may leave over a side with
/// headings in [least, most] on the way: a range from 0, at the right of one who looks outwards,
/// to 1.
bool find_way_out(const Shape& at, int side, double least, double most, bool exact, double& low,
                  double& high);

/// The places from `low` to `high` of a side of the part at [0, 1]^2.
Shape places_on(int side, double low, double high);

}  // namespace fairway_check
