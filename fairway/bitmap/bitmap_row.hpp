// The exact motion (vehicle/cell_motion.hpp) of all samples that enter one cell by one side with
// one heading: a row of a border's bitmap.
//
// What does not depend on the position along the side is computed once per row: the arc until it is
// aligned, meets the far side, or comes back to its own ("free arc", as if the cell had no sides
// next to the entry). Along the row there are then at most four stretches:
//   - so far right that the arc meets the right side first, so far left that it meets the left one:
//     one square root a sample;
//   - between them: an exit moved by the same shift for all (far side, or back to the entry side),
//     or aligned and out by a side, where the exit is a linear function of the position.
// Lengths are in cell sides. "Canonical" is the cell turned until the entry is its bottom, and
// mirrored when the turn is to the right: entries head up, turns are to the left.
// Agreement with cross_cell (observed): exits within 1e-13 cell sides, see bitmap_row_test.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "fairway/base/vec2.hpp"
#include "fairway/bitmap/bitmap_samples.hpp"
#include "fairway/vehicle/cell_motion.hpp"
#include "fairway/vehicle/side.hpp"

namespace fairway {

/// A cell's command, prepared.
struct BitmapCommand {
  Vec2 unit;  ///< (0, 0): none, straight
  double x_per_y = 0.0;
  double y_per_x = 0.0;
  int heading = 0;  ///< its sample

  static BitmapCommand of(const Direction& command, const BitmapSamples& samples) {
    const Vec2 c = command.unit;
    if (c == Vec2{}) return {};
    return {c, c.x / c.y, c.y / c.x, samples.heading_bin(c)};
  }
};

/// Where a sample leaves its cell, snapped to the samples of that border.
struct BitmapExit {
  Side side;
  int position;  ///< along the side, in the direction of +x or +y
  int heading;
};

class BitmapRow {
 public:
  BitmapRow() = default;

  /// Entry by `entry` with sample heading `heading`, which points into the cell. `turn_radius` > 1.
  BitmapRow(const BitmapSamples& samples, const BitmapCommand& command, double turn_radius,
            Side entry, int heading)
      : radius_(turn_radius), quarter_((static_cast<int>(entry) + 1) & 3) {
    u_ = turned(samples.unit(heading), 4 - quarter_);
    BitmapCommand c = command;
    if ((quarter_ & 1) != 0) std::swap(c.x_per_y, c.y_per_x);
    if ((quarter_ & 1) != 0) c.x_per_y = -c.x_per_y, c.y_per_x = -c.y_per_x;
    c.unit = turned(c.unit, 4 - quarter_);
    const double sine = cross(u_, c.unit);
    const double cosine = dot(u_, c.unit);
    mirrored_ = sine < 0.0;
    if (mirrored_) {
      u_.x = -u_.x;
      c.unit.x = -c.unit.x;
      c.x_per_y = -c.x_per_y;
      c.y_per_x = -c.y_per_x;
    }
    if (sine == 0.0 && cosine >= 0.0) {  // aligned, or no command
      far_heading_ = heading;
      go_straight({0.0, 0.0}, {u_, u_.x / u_.y, u_.y / u_.x, heading});
    } else {
      turn_left(samples, c, heading);
    }
  }

  /// Where the sample at `position` along the entry side leaves.
  BitmapExit exit(const BitmapSamples& samples, int position) const {
    const bool flipped = (quarter_ >= 2) != mirrored_;
    const double s = samples.position(flipped ? samples.count() - 1 - position : position);
    if (s > right_above_) {
      const double sine = u_.y + (1.0 - s) / radius_;
      return arc_exit(samples, Side::right, sine, std::sqrt(std::max(0.0, 1.0 - sine * sine)));
    }
    if (s < left_below_) {
      const double sine = u_.y - s / radius_;
      return arc_exit(samples, Side::left, sine, -std::sqrt(std::max(0.0, 1.0 - sine * sine)));
    }
    if (s >= far_low_ && s <= far_high_)
      return exit_at(samples, far_side_, s + far_shift_, far_heading_);
    return exit_at(samples, beside_, beside_at_ + beside_slope_ * s, far_heading_);
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  static Vec2 turned(Vec2 v, int quarters) {
    switch (quarters & 3) {
      case 1:
        return left_of(v);
      case 2:
        return -v;
      case 3:
        return -left_of(v);
      default:
        return v;
    }
  }

  /// The free arc. Its height is r (u.x - w.x) at heading w, its way to the right r (w.y - u.y).
  void turn_left(const BitmapSamples& samples, const BitmapCommand& c, int heading) {
    const double r = radius_;
    const Vec2 aligned{r * (c.unit.y - u_.y), r * (u_.x - c.unit.x)};
    double end_x = aligned.x;
    bool past_north = c.unit.y < 0.0 || c.unit.x <= 0.0;
    const bool over_top =
        c.unit.y >= 0.0 ? aligned.y >= 1.0 : r * (u_.x + 1.0) >= 1.0;  // highest when heading west
    if (over_top) {
      const double w_x = u_.x - 1.0 / r;
      end_x = r * (std::sqrt((1.0 - w_x) * (1.0 + w_x)) - u_.y);
      past_north = w_x <= 0.0;
      go_far(Side::top, end_x, world(samples, samples.sine_bin(-w_x)));
    } else if (c.unit.y >= 0.0 || aligned.y > 0.0) {
      far_heading_ = c.heading;
      go_straight(aligned, c);
    } else {  // back to the entry side, the heading mirrored there
      end_x = -2.0 * r * u_.y;
      const int canonical = samples.wrapped(heading - quarter_ * samples.quarter());
      const int back = samples.count() - 1 - canonical;
      go_far(Side::bottom, end_x, samples.wrapped(back + quarter_ * samples.quarter()));
    }
    const double rightmost = u_.x > 0.0 ? (past_north ? r * (1.0 - u_.y) : end_x) : 0.0;
    right_above_ = 1.0 - rightmost;
    left_below_ = std::max(0.0, -end_x);
  }

  void go_far(Side side, double shift, int heading) {
    far_side_ = side;
    far_shift_ = shift;
    far_heading_ = heading;
    far_low_ = -infinity;
    far_high_ = infinity;
  }

  /// Along c from `from`, which is measured from the entry.
  void go_straight(Vec2 from, const BitmapCommand& c) {
    if (c.unit.y != 0.0) {
      far_side_ = c.unit.y > 0.0 ? Side::top : Side::bottom;
      const double rise = c.unit.y > 0.0 ? 1.0 - from.y : -from.y;
      far_shift_ = from.x + rise * c.x_per_y;
      far_low_ = c.unit.x < 0.0 ? -far_shift_ : -infinity;
      far_high_ = c.unit.x > 0.0 ? 1.0 - far_shift_ : infinity;
    } else {
      far_low_ = infinity;
      far_high_ = -infinity;
    }
    beside_ = c.unit.x > 0.0 ? Side::right : Side::left;
    const double run = c.unit.x > 0.0 ? 1.0 - from.x : -from.x;
    beside_slope_ = -c.y_per_x;
    beside_at_ = from.y + run * c.y_per_x;
  }

  int world(const BitmapSamples& samples, int canonical) const {
    const int k = mirrored_ ? 2 * samples.quarter() - 1 - canonical : canonical;  // x turned round
    return samples.wrapped(k + quarter_ * samples.quarter());
  }

  BitmapExit arc_exit(const BitmapSamples& samples, Side side, double w_y, double w_x) const {
    // The right side is left heading east of north, the left side heading west.
    const int canonical = side == Side::right ? samples.sine_bin(w_y) - samples.quarter()
                                              : samples.sine_bin(-w_y) + samples.quarter();
    return exit_at(samples, side, radius_ * (u_.x - w_x), world(samples, canonical));
  }

  BitmapExit exit_at(const BitmapSamples& samples, Side side, double along, int heading) const {
    int s = static_cast<int>(side);
    const bool lies = (s & 1) != 0;  // top or bottom
    if (mirrored_ && !lies) s ^= 2;
    const int i = samples.position_bin(along);
    // Turning by 90, 180, 270 degrees turns the direction along some sides round.
    static constexpr std::array<std::array<bool, 2>, 4> turns_round{
        {{false, false}, {true, false}, {true, true}, {false, true}}};  // [quarter][lies]
    const bool flipped =
        turns_round[static_cast<std::size_t>(quarter_)][lies ? 1 : 0] != (mirrored_ && lies);
    return {static_cast<Side>((s + quarter_) & 3), flipped ? samples.count() - 1 - i : i, heading};
  }

  double radius_ = 0.0;
  Vec2 u_;
  double right_above_ = infinity;
  double left_below_ = -infinity;
  double far_low_ = 0.0;
  double far_high_ = 0.0;
  double far_shift_ = 0.0;
  double beside_at_ = 0.0;
  double beside_slope_ = 0.0;
  int quarter_ = 0;
  int far_heading_ = 0;
  Side far_side_ = Side::top;
  Side beside_ = Side::right;
  bool mirrored_ = false;
};

}  // namespace fairway
