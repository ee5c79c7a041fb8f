// Where a step of a behaviour crosses lines of parts.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "fairway/behaviour/behaviour_choices.hpp"
#include "fairway/behaviour/behaviour_flight.hpp"

namespace fairway {

/// Of `state`, after `along` of a step: an angle turned, or metres flown straight on.
inline BehaviourState within_step(const BehaviourState& from, const BehaviourStep& step,
                                  double along) {
  BehaviourState at = from;
  at.held = 0;
  if (step.turn == 0) {
    at.place = from.place + along * from.unit;
    return at;
  }
  at.heading_rad = Heading::from_rad(from.heading_rad + step.turn * along).rad();
  at.unit = {std::cos(at.heading_rad), std::sin(at.heading_rad)};
  at.place = from.place +
             step.turn * step.radius_m * Vec2{at.unit.y - from.unit.y, from.unit.x - at.unit.x};
  return at;
}

inline double whole_step(const BehaviourState& from, const BehaviourStep& step) {
  return step.turn == 0 ? step.length_m : turn_angle(from.heading_rad, step.heading_rad, step.turn);
}

/// The same step, ended sooner.
inline BehaviourStep shortened(const BehaviourStep& step, double along, const BehaviourState& end) {
  BehaviourStep shorter = step;
  if (step.turn == 0) shorter.length_m = along;
  shorter.heading_rad = end.heading_rad;
  return shorter;
}

/// Calls body(along) in order for lines of a lattice (`line_m` apart, from `origin`) that the step
/// crosses, where `matters(line, is_x, low, high)` says that the line may matter between these
/// places of it, in lattice units; until body returns true. A line that the step begins on is none
/// that it crosses. Steps turn by less than pi / 2.
template <typename Matters, typename Body>
bool for_crossings(const BehaviourState& from, const BehaviourStep& step, Vec2 origin,
                   double line_m, const Matters& matters, const Body& body) {
  const double all = whole_step(from, step);
  std::array<double, 3> cuts{0.0, all, all};
  int pieces = 1;
  if (step.turn != 0) {  // at a heading along an axis, pieces are monotone
    const double quarters = from.heading_rad / (0.5 * pi);
    const double next = step.turn > 0 ? std::floor(quarters) + 1.0 : std::ceil(quarters) - 1.0;
    const double until = step.turn * (next * (0.5 * pi) - from.heading_rad);
    if (until < all) {
      cuts[1] = until;
      pieces = 2;
    }
  }
  const double per_m = 1.0 / line_m;
  std::array<double, 16> found;
  for (int piece = 0; piece < pieces; ++piece) {
    const double begin = cuts[static_cast<std::size_t>(piece)];
    const double end = cuts[static_cast<std::size_t>(piece) + 1];
    const Vec2 a = per_m * (within_step(from, step, begin).place - origin);
    const Vec2 b = per_m * (within_step(from, step, end).place - origin);
    std::size_t count = 0;
    for (const bool is_x : {true, false}) {
      const double from_line = is_x ? a.x : a.y;
      const double to_line = is_x ? b.x : b.y;
      const double low = is_x ? std::min(a.y, b.y) : std::min(a.x, b.x);
      const double high = is_x ? std::max(a.y, b.y) : std::max(a.x, b.x);
      const double first = std::ceil(std::min(from_line, to_line));
      for (double line = first; line <= std::max(from_line, to_line); line += 1.0) {
        const bool begins_there = std::abs(line - from_line) < 1e-9;
        if (begins_there || count == found.size() || !matters(line, is_x, low, high)) continue;
        // By halving: both coordinates are monotone.
        double lo = begin;
        double hi = end;
        for (int k = 0; k < 48; ++k) {
          const double middle = 0.5 * (lo + hi);
          const Vec2 p = per_m * (within_step(from, step, middle).place - origin);
          const double at = is_x ? p.x : p.y;
          ((at < line) == (from_line < line) ? lo : hi) = middle;
        }
        found[count++] = hi;
      }
    }
    std::sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t k = 0; k < count; ++k) {
      if (body(found[k])) return true;
    }
  }
  return false;
}

}  // namespace fairway
