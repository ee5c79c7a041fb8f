#include "fairway/cellular/border_backward_set.hpp"

#include <optional>

#include "fairway/cellular/border_frame.hpp"

namespace fairway {
namespace {

/// A single turn: the heading it starts with and the one it ends with, which differ by less than
/// a quarter turn.
struct Turn {
  double start_rad;
  double end_rad;
};

/// The four candidates of a corner of the top border (paper 2, Fig. 3).
struct Corner {
  Vec2 at_m;
  Turn left;
  Turn right;
};

/// Eqs. 4 to 6 without centres: the angle between chord and tangent is half the angle turned.
Corner corner_through(Vec2 p, Vec2 corner, double r) {
  const Vec2 chord = corner - p;
  const double chord_rad = std::atan2(chord.y, chord.x);
  const double half_rad = std::asin(std::min(1.0, norm(chord) / (2.0 * r)));
  return {corner,
          {chord_rad - half_rad, chord_rad + half_rad},
          {chord_rad + half_rad, chord_rad - half_rad}};
}

// The turns that touch a side (Eq. 7): at the side the heading runs along it, and the distance to
// the side is r times one minus the cosine of the angle turned.
double angle_to_touch(double distance_m, double r) {
  return std::acos(std::clamp(1.0 - distance_m / r, -1.0, 1.0));
}

/// The right end of the top border. Left turns that bulge out on the right (Fig. 3d) and right
/// turns that come down on the corner from above (Fig. 3c) are replaced.
Corner right_corner(Vec2 p, const CellShape& shape) {
  const double d = shape.cell_m;
  const double r = shape.turn_radius_m;
  Corner c = corner_through(p, {d, d}, r);
  if (c.left.end_rad > pi / 2) c.left = {pi / 2 - angle_to_touch(d - p.x, r), pi / 2};
  if (c.right.end_rad < 0.0) c.right = {angle_to_touch(d - p.y, r), 0.0};
  return c;
}

/// The left end: Figs. 3e and 3b.
Corner left_corner(Vec2 p, const CellShape& shape) {
  const double d = shape.cell_m;
  const double r = shape.turn_radius_m;
  Corner c = corner_through(p, {0.0, d}, r);
  if (c.left.end_rad > pi) c.left = {pi - angle_to_touch(d - p.y, r), pi};
  if (c.right.end_rad < pi / 2) c.right = {pi / 2 + angle_to_touch(p.x, r), pi / 2};
  return c;
}

/// Counter-clockwise from a to b, [0, 2 pi).
double ahead(double a_rad, double b_rad) { return HeadingRange{a_rad, 0.0}.from_start(b_rad); }

/// The heading whose path leads past the corner; nothing when the corner lies in the gap.
std::optional<double> heading_past(const Corner& corner, Vec2 p, Vec2 command, double command_rad,
                                   double r) {
  // Commands between the two ends are reached before the corner: an arc, then the straight line
  // through it (Eqs. 8 to 10). The line's distance from p is the arc's sideways shift.
  const double between = ahead(corner.right.end_rad, corner.left.end_rad);
  if (ahead(corner.right.end_rad, command_rad) <= between) {
    const double left_of_line_m = cross(command, p - corner.at_m);
    const double turn = angle_to_touch(std::abs(left_of_line_m), r);
    return command_rad - std::copysign(turn, left_of_line_m);
  }
  // A turn is flown to its end if the command lies beyond it, and begun if the command is on its
  // side: less than half a turn away.
  const double left_turn = ahead(corner.left.start_rad, command_rad);
  if (left_turn <= pi && left_turn >= corner.left.end_rad - corner.left.start_rad)
    return corner.left.start_rad;
  const double right_turn = ahead(command_rad, corner.right.start_rad);
  if (right_turn <= pi && right_turn >= corner.right.start_rad - corner.right.end_rad)
    return corner.right.start_rad;
  return std::nullopt;
}

/// The top border's set in the frame in which it is the top.
HeadingSet towards_top(Vec2 p, const Direction& command, const CellShape& shape) {
  const Corner first = right_corner(p, shape);
  const Corner last = left_corner(p, shape);
  HeadingSet set;
  if (command.unit == Vec2{}) {  // no command: straight lines
    const double from = std::atan2(shape.cell_m - p.y, shape.cell_m - p.x);
    set.add({from, std::atan2(shape.cell_m - p.y, -p.x) - from});
    return set;
  }
  const double r = shape.turn_radius_m;
  const auto from = heading_past(first, p, command.unit, command.rad, r);
  const auto to = heading_past(last, p, command.unit, command.rad, r);
  const double opposite = command.rad - pi;  // where left turns begin and right turns end
  if (from && to) {
    set.add({*from, ahead(*from, *to)});
  } else if (to) {
    set.add({opposite, ahead(opposite, *to)});
  } else if (from) {
    set.add({*from, ahead(*from, opposite)});
  }
  return set;  // both corners in the gap: Eq. 11
}

Direction turned_direction(const Direction& d, int quarters) {
  if (d.unit == Vec2{}) return d;
  Vec2 unit = d.unit;
  for (int q = quarters & 3; q > 0; --q) unit = left_of(unit);
  return {unit, Heading::from_rad(d.rad + (quarters & 3) * (pi / 2)).rad()};
}

}  // namespace

HeadingSet backward_headings(Vec2 point_m, const Direction& command, const CellShape& shape,
                             Side exit) {
  const double d = shape.cell_m;
  require(d > 0.0 && d < shape.turn_radius_m, "0 < cell side < turning radius");
  require(point_m.x >= 0.0 && point_m.x <= d && point_m.y >= 0.0 && point_m.y <= d,
          "the point lies in the cell");
  const int quarters = quarters_between(exit, Side::top);
  HeadingSet set =
      towards_top(turned_in_cell(point_m, quarters, d), turned_direction(command, quarters), shape);
  for (std::size_t i = 0; i < set.count; ++i)
    set.ranges[i].from_rad = Heading::from_rad(set.ranges[i].from_rad - quarters * (pi / 2)).rad();
  return set;
}

HeadingSet backward_headings_on_border(Side entry, double along_m, const Direction& command,
                                       const CellShape& shape, Side exit) {
  const Vec2 point = point_on(entry, along_m, shape.cell_m);
  const double inwards = (static_cast<int>(entry) + 1) * (pi / 2);  // start of the half circle
  HeadingSet entering;
  for (const HeadingRange& range : backward_headings(point, command, shape, exit)) {
    for (const HeadingRange& part : common({inwards, pi}, range))
      entering.add({Heading::from_rad(part.from_rad).rad(), part.width_rad});
  }
  return entering;
}

}  // namespace fairway
