// A flight of one state to the section in plain doubles, for queries: several times as fast as the
// same state followed as a set (state_flight.hpp). It reports when double precision is not enough.
//
// Every number stands for the exact one within a ball: place, heading and centre of the circle each
// carry an error bound, per component. What happens next is decided by comparing numbers, and each
// comparison must have a margin far beyond the balls; else nothing is reported, and the state has
// to be followed as a set. This always happens near a border, a corner, a tangent or an opposite
// heading.
//
// Properties that always hold, when follow_point() returns true:
//   1. The visitor (section_flight.hpp) got exactly one report: what the exact flight of the exact
//      numbers meets, with its place inside the interval and its length within the bound reported.
//   2. The flight misses every corner, and every border that it does not cross, by more than the
//      balls: it is certain which cells it met.
// Error bounds (derived; docs/trust.md, lemma 8), with R the turning radius, L a straight length:
//   centre     p -+ R (u_y, -u_x)                        e_c = e_p + R e_u
//   crossing   t = (line - C) / R, n = sqrt(1 - t t)     e_t = e_c / R, e_n = e_t / n
//   its place  C -+ R n                                  e_p = e_c + R e_n
//   aligned    C +- R (c_y, -c_x)                        e_a = e_c
//   straight   p + L u, to a side with speed s           e = (e_p + 2 L e_u) (1 + 1 / s)
// each times 1.05, plus `rounding` (2^-46) of the largest number in it: no line has more than 16
// operations, each with an error of 2^-53 of numbers up to 4 R.
// Cost: one sine and one cosine per cell, and a square root for each of at most three sides.
#pragma once

#include <cmath>
#include <cstddef>

#include "fairway/base/interval.hpp"
#include "fairway/verify/flow.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

namespace point_flight {

inline constexpr double rounding = 0x1p-46;
/// No ball may be larger than this: as is for headings, times cell_m for places.
inline constexpr double most_error = 0x1p-20;
/// The margin that comparisons must have: as is for sines, times cell_m for places.
inline constexpr double margin = 0x1p-14;
/// The least outward part of the heading when crossing a side; flatter crossings are not followed.
inline constexpr double flattest = 0x1p-5;
/// In one cell of at most 0.95 R a vehicle turns by less than 85 degrees (its chord is at most
/// sqrt(2) d), whose cosine is 0.09: events this far ahead come after it has left.
inline constexpr double far_ahead = 0.05;
inline constexpr double largest_cell = 0.95;  // of R
inline constexpr int most_cells = 64;
inline constexpr int most_straight_cells = 1 << 14;

/// Where an arc meets a side or the command. Sides are numbers here, those of `Side`: even ones are
/// vertical, the first two are the far ones, and two more values are needed.
struct Event {
  int side = -1;  // 0 right, 1 top, 2 left, 3 bottom, 4 the command; -1 none
  double turned_sin = 2.0;
  double turned_cos = 0.0;
  double out = 0.0;    // the heading's part across the side, outwards
  double along = 0.0;  // and along it: y for right and left, else x
  double error = 0.0;  // of both parts
};

struct Point {
  int ix, iy;
  double x, y, error;      // in the cell's own coordinates
  double ux, uy, u_error;  // unit vector
  double cx = 0.0, cy = 0.0, c_error = 0.0;
  int turn = 0;           // 0: not yet on a circle
  double length_m = 0.0;  // never less than the length flown
};

/// Upper bound of the angle with this sine and cosine, up to 90 degrees. Huygens: 3 x <= 2 sin x +
/// tan x, for x half of it. An error in a component changes it by less than 3 times as much.
inline double angle_above(double sine, double cosine, double error) {
  const double half_cos = std::sqrt(0.5 * (1.0 + cosine));
  return (2.0 / 3.0) * (sine / half_cos + sine / (1.0 + cosine)) + 4.0 * error + 4.0 * rounding;
}

template <typename Visitor>
class Follower {
 public:
  Follower(const Flow& flow, Visitor& visitor)
      : flow_(flow),
        visitor_(visitor),
        d_(flow.grid.cell_m),
        r_(flow.vehicle.turn_radius_m),
        per_r_(1.0 / r_) {}

  bool follow(double x_m, double y_m, double heading_rad) {
    if (!(d_ <= largest_cell * r_)) return false;
    Point p{};
    if (!place(x_m, flow_.grid.x0_m, p.ix, p.x, p.error)) return false;
    if (!place(y_m, flow_.grid.y0_m, p.iy, p.y, p.error)) return false;
    p.ux = std::cos(heading_rad);
    p.uy = std::sin(heading_rad);
    p.u_error = rounding;
    if (met_end(p)) return true;
    for (int cells = 0; cells < most_cells; ++cells) {
      switch (cross(p)) {
        case Step::unsure:
          return false;
        case Step::told:
          return true;
        case Step::onwards:
          break;
      }
    }
    return false;
  }

 private:
  enum class Step { unsure, told, onwards };

  bool is_between(double x) const { return x > margin * d_ && x < d_ - margin * d_; }

  /// One coordinate inside its cell; false when it may be in another, or is not accurate enough.
  bool place(double x_m, double origin_m, int& cell, double& local_m, double& error) const {
    const double after = x_m - origin_m;
    const double number = std::floor(after / d_);
    cell = static_cast<int>(number);
    local_m = after - number * d_;
    error = std::max(error, rounding * (std::abs(x_m) + std::abs(origin_m) + std::abs(after)));
    return is_between(local_m) && error <= most_error * d_;
  }

  /// In a cell that ends the flight.
  bool met_end(const Point& p) {
    const CellKind kind = flow_.kind_at({p.ix, p.iy});
    if (kind == CellKind::ordinary) return false;
    visitor_.end(kind == CellKind::target     ? Verdict::reach
                 : kind == CellKind::obstacle ? Verdict::collide
                                              : Verdict::leave,
                 p.length_m);
    return true;
  }

  Step cross(Point& p) {
    const double command = static_cast<double>(flow_.heading_rad[flow_.grid.index({p.ix, p.iy})]);
    if (std::isnan(command)) return go_straight(p);
    const double cx = std::cos(command);
    const double cy = std::sin(command);
    const double left = p.ux * cy - p.uy * cx;
    const double ahead = p.ux * cx + p.uy * cy;
    if (std::abs(left) < margin) return Step::unsure;  // aligned, or opposite
    const int turn = left > 0.0 ? 1 : -1;
    const double kr = turn * r_;
    if (p.turn != turn) {
      p.turn = turn;
      p.cx = p.x - kr * p.uy;
      p.cy = p.y + kr * p.ux;
      p.c_error = 1.05 * (p.error + r_ * p.u_error) + rounding * r_;
    }
    if (!(p.c_error <= most_error * d_ && p.u_error <= most_error)) return Step::unsure;

    Event first;
    double second_sin = 2.0;
    if (ahead > far_ahead) {
      first = {4, std::abs(left), ahead, 0.0, 0.0, p.u_error};
    }
    for (int side = 0; side < 4; ++side) {
      Event event;
      if (!crossing(p, side, event)) return Step::unsure;
      if (event.side < 0) continue;
      if (event.turned_sin < first.turned_sin) {
        second_sin = first.turned_sin;
        first = event;
      } else {
        second_sin = std::min(second_sin, event.turned_sin);
      }
    }
    if (first.side < 0 || !(second_sin - first.turned_sin > margin)) return Step::unsure;
    p.length_m += r_ * angle_above(first.turned_sin, first.turned_cos,
                                   4.0 * std::max(p.u_error, first.error) + rounding);
    if (first.side == 4) return go_aligned(p, p.cx + kr * cy, p.cy - kr * cx, cx, cy);
    return go_over(p, first);
  }

  /// Where the circle crosses the side outwards, if that may be the next event. False: unsure.
  bool crossing(const Point& p, int side, Event& event) const {
    const bool vertical = side % 2 == 0;
    const double outwards = side < 2 ? 1.0 : -1.0;
    const double k = vertical ? p.turn : -p.turn;
    const double u_out = outwards * (vertical ? p.ux : p.uy);
    const double u_along = vertical ? p.uy : p.ux;
    // After 90 degrees the heading is (-k' u_along, ...) in this frame. Every heading before it is
    // a sum of both with weights >= 0: none points out of this side when both point in.
    const double last_out = -k * outwards * u_along;
    if (u_out < 0.0 && last_out < 0.0) return true;
    const double line = side < 2 ? d_ : 0.0;
    const double t = k * (line - (vertical ? p.cx : p.cy)) * per_r_;
    const double flat = 1.0 - t * t;
    if (flat < -margin) return true;  // the circle does not reach the line
    if (!(flat > flattest * flattest)) return false;
    const double n = std::sqrt(flat);
    const double error = 1.05 * (1.05 * p.c_error * per_r_ + rounding) / n + rounding;
    if (!(error <= most_error)) return false;
    // In the frame (outwards, along) a left turn is k' = k * outwards.
    const double turned = k * outwards * (u_out * t - u_along * n);
    const double ahead = u_out * n + u_along * t;
    if (ahead < far_ahead || turned < -margin) return true;
    if (turned < margin) return false;
    event = {side, turned, ahead, n, t, error};
    return true;
  }

  Step go_over(Point& p, const Event& event) {
    const bool vertical = event.side % 2 == 0;
    const double outwards = event.side < 2 ? 1.0 : -1.0;
    const double k = vertical ? p.turn : -p.turn;
    const double place = (vertical ? p.cy : p.cx) - k * r_ * outwards * event.out;
    p.error = 1.05 * (p.c_error + r_ * event.error) + rounding * r_;
    if (!is_between(place) || !(p.error <= most_error * d_)) return Step::unsure;
    const double u_out = outwards * event.out;
    p.ux = vertical ? u_out : event.along;
    p.uy = vertical ? event.along : u_out;
    p.u_error = event.error;
    // The coordinate across the side is measured from the next cell's corner.
    (vertical ? p.cx : p.cy) -= outwards * d_;
    p.c_error += rounding * r_;
    enter(p, event.side, place);
    return met_end(p) ? Step::told : Step::onwards;
  }

  void enter(Point& p, int side, double place) const {
    const bool vertical = side % 2 == 0;
    const double line = side < 2 ? 0.0 : d_;
    p.x = vertical ? line : place;
    p.y = vertical ? place : line;
    (vertical ? p.ix : p.iy) += side < 2 ? 1 : -1;
  }

  /// From (x, y), inside the cell, along the command to the side it leaves by: the section there.
  Step go_aligned(Point& p, double x, double y, double cx, double cy) {
    if (!is_between(x) || !is_between(y)) return Step::unsure;
    // An axis along which it hardly moves: at most half the margin until it reaches the other side.
    const auto length_to_side = [this](double from, double speed) {
      if (std::abs(speed) < 0.25 * margin) return 4.0 * d_;
      return (speed > 0.0 ? d_ - from : -from) / speed;
    };
    const double to_x = length_to_side(x, cx);
    const double to_y = length_to_side(y, cy);
    const bool vertical = to_x < to_y;
    const double length = std::min(to_x, to_y);
    const double speed = std::abs(vertical ? cx : cy);
    const double place = vertical ? y + length * cy : x + length * cx;
    const double moved = 1.05 * p.c_error + rounding * r_ + 2.0 * d_ * rounding;
    const double error = 1.05 * (moved + moved / speed) + rounding * r_ / speed;
    if (!is_between(place) || !(error <= most_error * d_)) return Step::unsure;
    const int side = vertical ? (cx > 0.0 ? 0 : 2) : (cy > 0.0 ? 1 : 3);
    const std::size_t section = 4 * flow_.grid.index({p.ix, p.iy}) + static_cast<std::size_t>(side);
    p.length_m += length + 2.0 * error;
    enter(p, side, place);
    if (met_end(p)) return Step::told;
    visitor_.arrive(section, Interval(place - error, place + error), p.length_m, false);
    return Step::told;
  }

  /// Through cells without a command, to one that has one or ends the flight. Every crossing is
  /// computed from the start of the straight line, so that errors do not accumulate.
  Step go_straight(Point& p) {
    if (std::min(std::abs(p.ux), std::abs(p.uy)) < most_error) return Step::unsure;
    const Point start = p;
    for (int cells = 0; cells < most_straight_cells; ++cells) {
      const double west = d_ * (p.ix - start.ix);  // of this cell, in the first cell's coordinates
      const double south = d_ * (p.iy - start.iy);
      const double to_x = (west + (p.ux > 0.0 ? d_ : 0.0) - start.x) / p.ux;
      const double to_y = (south + (p.uy > 0.0 ? d_ : 0.0) - start.y) / p.uy;
      const bool vertical = to_x < to_y;
      const double length = std::min(to_x, to_y);
      const double speed = std::abs(vertical ? p.ux : p.uy);
      const double place =
          vertical ? start.y + length * p.uy - south : start.x + length * p.ux - west;
      const double moved = start.error + 2.0 * length * p.u_error;
      p.error = 1.05 * (moved + moved / speed) + rounding * (r_ + 4.0 * length) / speed;
      if (!is_between(place) || !(p.error <= most_error * d_)) return Step::unsure;
      enter(p, vertical ? (p.ux > 0.0 ? 0 : 2) : (p.uy > 0.0 ? 1 : 3), place);
      const bool ended = flow_.kind_at({p.ix, p.iy}) != CellKind::ordinary;
      if (!ended && std::isnan(flow_.heading_rad[flow_.grid.index({p.ix, p.iy})])) continue;
      p.turn = 0;
      p.length_m += length + 2.0 * p.error;
      if (met_end(p)) return Step::told;
      return speed < flattest ? Step::unsure : Step::onwards;
    }
    return Step::unsure;
  }

  const Flow& flow_;
  Visitor& visitor_;
  double d_;
  double r_;
  double per_r_;
};

}  // namespace point_flight

/// Follows the state if double precision provably suffices; otherwise returns false and reports
/// nothing. The state is finite and within 2^30 cells of the grid.
template <typename Visitor>
[[nodiscard]] bool follow_point(const Flow& flow, double x_m, double y_m, double heading_rad,
                                Visitor& visitor) {
  return point_flight::Follower<Visitor>(flow, visitor).follow(x_m, y_m, heading_rad);
}

}  // namespace fairway
