// A flight from any state of the configuration space to the section.
//
// Properties that always hold: those of section_flight.hpp; and a state on a border, exactly or
// within rounding, is followed in every cell it may belong to: the one its heading points into, or
// both when it may run along the border. Contact with a closed obstacle cell is a `collide`.
// Within rounding includes the numbers given: a caller who computes the position of a border, or a
// heading opposite to a command, in doubles gets what holds for the border and both turns.
#pragma once

#include <cmath>

#include "fairway/base/interval.hpp"
#include "fairway/verify/point_flight.hpp"
#include "fairway/verify/section_flight.hpp"

namespace fairway {

namespace state_flight {

/// The sum; a single double when it is exact (Knuth's two-sum).
inline Interval sum(double a, double b) {
  const double s = a + b;
  const double t = s - a;
  const double error = (a - (s - t)) + (b - t);
  return error == 0.0 ? Interval(s) : outward(s, s);
}

/// The possible positions `cell` cells after `origin` on an axis.
inline Interval border(double origin, int cell, double cell_m) {
  const double product = cell * cell_m;
  const bool exact = std::fma(static_cast<double>(cell), cell_m, -product) == 0.0;
  return exact ? sum(origin, product) : Interval(origin) + outward(product, product);
}

inline Interval after(double position, Interval border) {
  return border.lo == border.hi ? sum(position, -border.lo) : Interval(position) - border;
}

/// `position` in the coordinates of `cell` along one axis, computed from both borders unless both
/// are exact.
inline Interval local(double position, double origin, int cell, double cell_m) {
  const Interval low = after(position, border(origin, cell, cell_m));
  const Interval high = after(position, border(origin, cell + 1, cell_m));
  if (low.lo == low.hi && high.lo == high.hi) return low;
  return hull(low, Interval(cell_m) + high);
}

/// Unit vectors within 2^-50 of a heading: 8 rounding units of a number near pi. 0 is exact.
inline IntervalVec2 direction(double rad) {
  const IntervalVec2 u = unit_enclosure(rad);
  if (rad == 0.0) return u;
  const Interval slack{-0x1p-50, 0x1p-50};
  return {intersection(u.x + slack, {-1.0, 1.0}), intersection(u.y + slack, {-1.0, 1.0})};
}

/// False when a state at `p`, exactly on a side of the cell, heads out of it (into another).
inline bool belongs(Interval p, Interval u, double cell_m) {
  const bool on_low = p.lo == 0.0 && p.hi == 0.0;
  const bool on_high = p.lo == cell_m && p.hi == cell_m;
  return !(on_low && u.negative()) && !(on_high && u.positive());
}

}  // namespace state_flight

/// Follows the state (x_m, y_m, heading_rad), any finite numbers, within 2^30 cells of the grid, as
/// a set as small as rounding errors.
template <typename Visitor>
void follow_state_as_set(const Flow& flow, double x_m, double y_m, double heading_rad,
                         int most_crossings, Visitor& visitor) {
  const double d = flow.grid.cell_m;
  const IntervalVec2 u = state_flight::direction(heading_rad);
  const int cx = static_cast<int>(std::floor((x_m - flow.grid.x0_m) / d));
  const int cy = static_cast<int>(std::floor((y_m - flow.grid.y0_m) / d));
  for (int iy = cy - 1; iy <= cy + 1; ++iy) {
    const Interval y = state_flight::local(y_m, flow.grid.y0_m, iy, d);
    if (intersection(y, {0.0, d}).empty()) continue;
    for (int ix = cx - 1; ix <= cx + 1; ++ix) {
      const Interval x = state_flight::local(x_m, flow.grid.x0_m, ix, d);
      if (intersection(x, {0.0, d}).empty()) continue;
      const CellKind kind = flow.kind_at({ix, iy});
      if (kind == CellKind::obstacle) visitor.end(Verdict::collide, 0.0);
      if (!state_flight::belongs(x, u.x, d) || !state_flight::belongs(y, u.y, d)) continue;
      if (kind == CellKind::target) visitor.end(Verdict::reach, 0.0);
      if (kind == CellKind::outside) visitor.end(Verdict::leave, 0.0);
      if (kind != CellKind::ordinary) continue;
      Front front;
      front.ix = ix;
      front.iy = iy;
      front.entry.position_m = {intersection(x, {0.0, d}), intersection(y, {0.0, d})};
      front.entry.heading = u;
      const float tag = static_cast<float>(heading_rad);
      if (static_cast<double>(tag) == heading_rad) front.heading_rad = tag;
      follow_to_section(flow, front, most_crossings, visitor);
    }
  }
}

/// The same, without a set where double precision provably suffices.
template <typename Visitor>
void follow_state(const Flow& flow, double x_m, double y_m, double heading_rad, int most_crossings,
                  Visitor& visitor) {
  if (follow_point(flow, x_m, y_m, heading_rad, visitor)) return;
  follow_state_as_set(flow, x_m, y_m, heading_rad, most_crossings, visitor);
}

}  // namespace fairway
