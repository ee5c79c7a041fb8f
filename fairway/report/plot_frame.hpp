// A rectangle of the page that shows a range of two quantities, with its axes.
#pragma once

#include <string>

#include "fairway/report/canvas.hpp"

namespace fairway {

struct Axis {
  double low = 0.0;
  double high = 1.0;  ///< above low
  std::string label;
  int ticks_wanted = 6;
};

struct PlotFrame {
  Rect rect;
  Axis x;
  Axis y;

  /// The place on the page of a point given in the quantities.
  Vec2 to_page(Vec2 p) const {
    return {rect.x + (p.x - x.low) / (x.high - x.low) * rect.width,
            rect.bottom() - (p.y - y.low) / (y.high - y.low) * rect.height};
  }
  Vec2 from_page(Vec2 p) const {
    return {x.low + (p.x - rect.x) / rect.width * (x.high - x.low),
            y.low + (rect.bottom() - p.y) / rect.height * (y.high - y.low)};
  }
};

/// Room the labels of the y axis take to the left of the frame, points.
[[nodiscard]] double y_axis_room_pt(const Axis& y);
/// Room the labels of the x axis take below the frame, points.
inline constexpr double x_axis_room_pt = 30.0;

/// The frame, ticks, numbers and labels, as the layer "axes"; with `grid`, pale lines across.
void draw_axes(Canvas& canvas, const PlotFrame& frame, bool grid);

}  // namespace fairway
