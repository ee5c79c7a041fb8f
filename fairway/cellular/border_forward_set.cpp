#include "fairway/cellular/border_forward_set.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/cellular/border_frame.hpp"

namespace fairway {
namespace {

/// A range on the line of angles; empty when first > last.
struct Stretch {
  double first;
  double last;
};

/// Exit headings at `q` of all left arcs that begin on the bottom, whatever the command: those of
/// the arcs from its left corner and from its right corner, unless these bulge out of the cell
/// first (paper 2, Figs. 9c, 14).
Stretch left_arcs(Vec2 q, Side exit, const CellShape& shape) {
  const double d = shape.cell_m;
  const double r = shape.turn_radius_m;
  if (exit == Side::bottom) {
    // Down again, mirrored: a chord of 2 r sin(w - pi) to the left.
    return {pi, pi + std::asin(std::min(1.0, (d - q.x) / (2.0 * r)))};
  }
  const auto arc_from = [&](double corner_x, double& start_rad) {
    const Vec2 chord{q.x - corner_x, q.y};
    const double chord_rad = std::atan2(chord.y, chord.x);
    const double half_rad = std::asin(std::min(1.0, norm(chord) / (2.0 * r)));
    start_rad = chord_rad - half_rad;
    return chord_rad + half_rad;
  };
  double start_rad = 0.0;
  double first = arc_from(0.0, start_rad);
  if (start_rad < 0.0) first = std::acos(1.0 - q.y / r);  // touches the bottom
  if (exit == Side::right) return {first, pi / 2};        // the last one touches the right side
  double last = arc_from(d, start_rad);
  if (start_rad < pi / 2) last = pi - std::asin(1.0 - (d - q.x) / r);  // touches the right side
  return {first, last};
}

/// What remains of them under a command (in [0, 2 pi) in this frame).
Stretch flown_left_arcs(const Stretch& arcs, Vec2 q, double command_rad, double r) {
  Stretch flown{arcs.first, std::min(arcs.last, command_rad)};
  if (command_rad < pi) return flown;  // less than half a turn from any start
  const double cosine = std::cos(command_rad - pi) - q.y / r;
  if (cosine < -1.0) return {1.0, 0.0};                   // Eq. 16: no arc from there comes as high
  const double limit = std::acos(std::min(1.0, cosine));  // Eqs. 12, 15
  return {std::max(flown.first, limit), std::min(flown.last, two_pi - limit)};
}

double on_circle(double rad) { return HeadingRange{0.0, 0.0}.from_start(rad); }

/// With the bottom as border of entry. Headings leave the cell when within a quarter turn of the
/// outward normal.
HeadingSet from_bottom(Side exit, Vec2 q, const Direction& command, const CellShape& shape) {
  const double d = shape.cell_m;
  const double r = shape.turn_radius_m;
  HeadingSet set;
  if (command.unit == Vec2{}) {  // no command: straight lines, none back to the bottom
    const double first = std::atan2(q.y, q.x);
    if (exit != Side::bottom) set.add({first, std::atan2(q.y, q.x - d) - first});
    return set;
  }
  const double c = on_circle(command.rad);
  const Stretch left = left_arcs(q, exit, shape);
  const Stretch flown_left = flown_left_arcs(left, q, c, r);
  if (flown_left.first <= flown_left.last)
    set.add({flown_left.first, flown_left.last - flown_left.first});

  // Right arcs in the mirror: x to d - x, headings to pi - heading.
  const Vec2 mirror_q{d - q.x, q.y};
  const Side mirror_exit = exit == Side::right  ? Side::left
                           : exit == Side::left ? Side::right
                                                : exit;
  const Stretch right = left_arcs(mirror_q, mirror_exit, shape);
  const Stretch flown_right = flown_left_arcs(right, mirror_q, on_circle(pi - c), r);
  if (flown_right.first <= flown_right.last)
    set.add({pi - flown_right.last, flown_right.last - flown_right.first});

  const double first_right = pi - right.last;
  const HeadingRange aligned{first_right, on_circle(left.last - first_right)};
  const HeadingRange outwards{static_cast<int>(exit) * (pi / 2) - pi / 2, pi};
  if (aligned.holds(c) && outwards.holds(c)) set.add({c, 0.0});
  return set;
}

}  // namespace

HeadingSet forward_headings(Side entry, Side exit, double along_m, const Direction& command,
                            const CellShape& shape) {
  const double d = shape.cell_m;
  require(d > 0.0 && d < shape.turn_radius_m, "0 < cell side < turning radius");
  require(along_m >= 0.0 && along_m <= d, "the point lies on the border");
  const int quarters = quarters_between(entry, Side::bottom);
  const Vec2 q = turned_in_cell(point_on(exit, along_m, d), quarters, d);
  Direction c = command;
  if (c.unit != Vec2{}) c.rad += quarters * (pi / 2);
  HeadingSet set = from_bottom(turned(exit, quarters), q, c, shape);
  for (std::size_t i = 0; i < set.count; ++i)
    set.ranges[i].from_rad = Heading::from_rad(set.ranges[i].from_rad - quarters * (pi / 2)).rad();
  return set;
}

}  // namespace fairway
