#include "check/contract_rules.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fairway_check {
namespace {

using std::numbers::pi;

/// By which a distance from a side may err.
constexpr double depth_slack = 0x1p-28;

/// Angle between headings that are `turn` apart, at most 180 degrees.
double between(double turn) {
  const double size = std::abs(turn);
  if (size <= pi) return size;
  if (size < 3.0 * pi) return std::abs(size - 2.0 * pi);
  return std::abs(std::remainder(turn, 2.0 * pi));
}

}  // namespace

double around_from(double angle) {
  const bool is_once = angle >= 0.0 && angle < 2.0 * pi;
  const double turn = is_once ? angle : angle - 2.0 * pi * std::floor(angle / (2.0 * pi));
  return turn > 2.0 * pi - angle_slack ? turn - 2.0 * pi : turn;
}

bool is_loose(const Arc& arc, const Contract& contract) {
  return !(arc.width < pi - contract.side_uncertain - angle_slack) ||
         arc.width > 2.0 * contract.hold_side - angle_slack;
}

Choices choices_in(double first, double width, double start, double step, Memory memory,
                   const Contract& contract) {
  const double hold_from = contract.hold_side - angle_slack;  // may be far from here on
  const double hold_to = contract.hold_side + angle_slack;    // may be near up to here
  const double opposite = pi + contract.side_uncertain + angle_slack;
  const double low = around_from(start - first);
  const double high = low + step;
  const double in_arc = std::min(high, width - angle_slack) - std::max(low, angle_slack);
  const bool wholly = high <= width + angle_slack;
  Choices c{.aligns = wholly || in_arc > 0.0 || high > 2.0 * pi + angle_slack};
  if (wholly) {
    // Held to this side while a command at the end passed first is far: turns on, out of the arc.
    c.goes_on = memory.side && high > hold_from;
    c.on = {false, c.goes_on};
    return c;
  }
  // Angles to the arc onwards (a) and back (b): their ranges over the step.
  const double a_most = 2.0 * pi - low;
  const double a_least = std::max(0.0, a_most - step);
  const double b_least = std::max(0.0, low - width);
  const double b_most = std::max(0.0, high - width);
  const bool near_on = a_least <= hold_to;
  const bool near_back = b_least <= hold_to;
  const bool faces_opposite = a_least <= pi && a_most + width >= pi;
  const bool far =
      faces_opposite || std::max({between(a_least), between(a_most), between(a_least + width),
                                  between(a_most + width)}) > hold_from;
  const bool forgets = memory.nothing || near_on || near_back;
  const bool chooses_on =
      forgets && a_least <= opposite && std::min(a_most + width, opposite) > hold_from;
  const bool chooses_back =
      forgets && b_least <= opposite && std::min(b_most + width, opposite) > hold_from;
  c.on = {near_on, (memory.side && far) || chooses_on};
  c.back = {near_back, chooses_back};
  c.goes_on = c.on.any();
  c.turns_back = c.back.any();
  c.alternates = (near_on || near_back) && (near_on || chooses_on) && c.turns_back;
  return c;
}

void find_turning_points(double first, double width, const Contract& contract,
                         double (&found)[turning_points]) {
  const double hold = contract.hold_side;
  const double opposite = pi + contract.side_uncertain;
  int n = 0;
  for (const double end : {first, first + width}) {
    for (const double away : {0.0, hold, -hold, opposite, -opposite}) found[n++] = end + away;
  }
}

bool keep_to(const Arc& arc, int turn, double clock, double step, Memory memory,
             const Contract& contract) {
  const double first = turn > 0 ? arc.right : -(arc.right + arc.width);
  return around_from(clock - first) + step <= arc.width + angle_slack && !is_loose(arc, contract) &&
         !choices_in(first, arc.width, clock, step, memory, contract).goes_on;
}

bool point_outwards(int side, double& least, double& most) {
  const double middle = 0.5 * (least + most);
  const double half = 0.5 * (most - least);
  const double from_side = std::remainder(middle - side * (0.5 * pi), 2.0 * pi);
  if (std::abs(from_side) - half > 0.5 * pi) return false;
  least = middle - from_side + std::max(from_side - half, -0.5 * pi);
  most = middle - from_side + std::min(from_side + half, 0.5 * pi);
  return true;
}

Shape places_on(int side, double low, double high) {
  switch (side) {
    case 0:
      return {{1.0, low}, {1.0, high}};
    case 1:
      return {{1.0 - low, 1.0}, {1.0 - high, 1.0}};
    case 2:
      return {{0.0, 1.0 - low}, {0.0, 1.0 - high}};
    default:
      return {{low, 0.0}, {high, 0.0}};
  }
}

bool find_way_out(const Shape& at, int side, double least, double most, bool exact, double& low,
                  double& high) {
  const double half = 0.5 * (most - least);
  const double from_side = std::remainder(0.5 * (least + most) - side * (0.5 * pi), 2.0 * pi);
  const double right = from_side - half;  // bounds of the cone, from the direction outwards
  const double left = from_side + half;
  constexpr double along = 0.5 * pi - angle_slack;
  if (right > 0.5 * pi + angle_slack || left < -0.5 * pi - angle_slack) return false;
  const double to_right = std::tan(std::min(right, along));
  const double to_left = std::tan(std::max(left, -along));
  low = HUGE_VAL;
  high = -HUGE_VAL;
  for (const Point p : at.corners()) {
    const double place = side == 0 ? p.y : side == 1 ? 1.0 - p.x : side == 2 ? 1.0 - p.y : p.x;
    const double away = side == 0 ? 1.0 - p.x : side == 1 ? 1.0 - p.y : side == 2 ? p.x : p.y;
    if (exact && away == 0.0) {
      low = std::min(low, place);
      high = std::max(high, place);
      continue;
    }
    const double nearest = std::max(0.0, away - depth_slack);
    const double farthest = std::max(0.0, away) + depth_slack;
    low = std::min(low, place + (to_right > 0.0 ? nearest : farthest) * to_right - touch);
    high = std::max(high, place + (to_left < 0.0 ? nearest : farthest) * to_left + touch);
  }
  // A cone that reaches back beyond the line of the side reaches all of the line.
  if (right <= -along) low = -HUGE_VAL;
  if (left >= along) high = HUGE_VAL;
  low = std::max(0.0, low);
  high = std::min(1.0, high);
  return low <= high;
}

}  // namespace fairway_check
