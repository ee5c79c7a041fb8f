#include "check/contract_following.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "check/contract_rules.hpp"

namespace fairway_check {
namespace {

using std::numbers::pi;

constexpr int most_work = 1 << 14;

/// Restricts where an aligned set leaves over a side, if no heading (middle +- half) goes the other
/// way along it.
void keep_sure(Cell part, int side, double middle, double half, const Box& sure, double& low,
               double& high) {
  const double off = std::abs(std::remainder(middle - (side + 1) * (0.5 * pi), 2.0 * pi));
  const double x0 = sure.x0 - part.x;
  const double x1 = sure.x1 - part.x;
  const double y0 = sure.y0 - part.y;
  const double y1 = sure.y1 - part.y;
  const double from[4]{y0, 1.0 - x1, 1.0 - y1, x0};
  const double to[4]{y1, 1.0 - x0, 1.0 - y0, x1};
  if (off + half <= 0.5 * pi) low = std::max(low, from[side]);
  if (off - half >= 0.5 * pi) high = std::min(high, to[side]);
}

}  // namespace

Past Past::with(double least, double most, double further, double turn) const {
  return {std::min(least_rad, least), std::max(most_rad, most), length + further, turned + turn};
}

Past Past::joined(const Past& other) const {
  return {std::min(least_rad, other.least_rad), std::max(most_rad, other.most_rad),
          std::max(length, other.length), std::max(turned, other.turned)};
}

Following::Following(const Parts& parts, const Contract& contract)
    : parts_(parts),
      contract_(contract),
      least_radius_(contract.least_radius / parts.side_m),
      most_radius_(contract.most_radius / parts.side_m) {}

void Following::begin(Cell origin, Sightings& sightings) {
  sightings_ = &sightings;
  origin_ = origin;
  work_ = 0;
  lost_ = false;
}

void Following::lose() {
  if (!lost_) sightings_->give_up();
  lost_ = true;
}

bool Following::spend() {
  if (++work_ > most_work) lose();
  return !lost_;
}

void Following::end_in(CellKind kind, const Past& past) const {
  sightings_->end(kind == target ? reach : kind == obstacle ? collide : leave, past);
}

void Following::touch_ends(const Shape& at, const Past& past) const {
  for_parts(at, touch, [&](Cell part, const Shape&) {
    const CellKind kind = kind_of(part);
    if (kind != ordinary) end_in(kind, past);
  });
}

/// Aligned in a part, `heading` among the headings. The way in the cone of its arc is shorter than
/// what it gains along the middle of the cone, divided by the cosine of half its width.
void Following::align(Cell part, const Shape& at, bool begins, const Box& sure, double heading,
                      const Past& past) const {
  const Arc arc = arc_of(part);
  const double right = heading - around_from(heading - arc.right);
  const double middle_rad = right + 0.5 * arc.width;
  const Point middle = unit(middle_rad);
  visit(part, right, right + arc.width);
  const bool exact = begins && sure.x0 > -HUGE_VAL;
  const double length =
      (1.0 + 8.0 * touch) * (std::abs(middle.x) + std::abs(middle.y)) / std::cos(0.5 * arc.width);
  const Past then = past.with(right, right + arc.width, length, 0.0);
  const Shape inside = moved(at, -1.0 * corner_of(part));
  for (int side = 0; side < 4; ++side) {
    double low = 0.0;
    double high = 0.0;
    if (find_way_out(inside, side, right, right + arc.width, exact, low, high)) {
      keep_sure(part, side, middle_rad, 0.5 * arc.width, sure, low, high);
      sightings_->cross(index_of(part), side, low, high, then);
    }
  }
}

}  // namespace fairway_check
