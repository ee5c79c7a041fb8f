// Places and the parts they lie in; lengths in parts.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "check/contract_parts.hpp"
#include "check/shape.hpp"

namespace fairway_check {

/// How deep those that touch a part from outside may lie in it; and how far beyond its sides those
/// may lie that are followed in it: the same, so that no one is left out and no one is in both.
inline constexpr double skin = 1.5 * touch;
inline constexpr double blur = 0x1p-40;  ///< of a comparison with it
inline constexpr double part_diagonal = std::numbers::sqrt2 * (1.0 + 8.0 * touch);

inline Point unit(double rad) { return {std::cos(rad), std::sin(rad)}; }
inline Point corner_of(Cell part) {
  return {static_cast<double>(part.x), static_cast<double>(part.y)};
}
inline Box box_of(Cell part) {
  return {static_cast<double>(part.x), static_cast<double>(part.y), part.x + 1.0, part.y + 1.0};
}

inline Cell part_of(Point p) {
  return {static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y))};
}
/// Whether it is in the part and farther than this from all of its sides.
inline bool is_deep_in(Point p, Cell part, double by) {
  const Box box = box_of(part).grown(-by);
  return p.x > box.x0 && p.x < box.x1 && p.y > box.y0 && p.y < box.y1;
}

Shape moved(const Shape& at, Point by);

/// With all corners moved into the box, from at most `blur` beyond it.
Shape within(const Shape& at, const Box& box);

/// Calls for every part that `at` comes within `margin` of, with what lies there; by rows, for as
/// long as `visit` says true.
template <typename Visit>
void for_parts_while(const Shape& at, double margin, Visit visit) {
  const Box all = at.bounds();
  const auto first = [margin](double low) { return static_cast<int>(std::floor(low - margin)); };
  const auto last = [margin](double high) { return static_cast<int>(std::floor(high + margin)); };
  for (int y = first(all.y0); y <= last(all.y1); ++y) {
    const Shape row = clipped(at, Box{-HUGE_VAL, y - margin, HUGE_VAL, y + 1.0 + margin});
    if (row.empty()) continue;
    const Box in_row = row.bounds();
    for (int x = first(in_row.x0); x <= last(in_row.x1); ++x) {
      const Shape there = clipped(row, box_of({x, y}).grown(margin));
      if (!there.empty() && !visit(Cell{x, y}, there)) return;
    }
  }
}

/// The same for all.
template <typename Visit>
void for_parts(const Shape& at, double margin, Visit visit) {
  for_parts_while(at, margin, [&visit](Cell part, const Shape& there) {
    visit(part, there);
    return true;
  });
}

}  // namespace fairway_check
