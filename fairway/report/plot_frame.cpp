#include "fairway/report/plot_frame.hpp"

#include <algorithm>

#include "fairway/report/ticks.hpp"

namespace fairway {
namespace {

constexpr double tick_pt = 3.5;
constexpr TextStyle number_style{.size_pt = 8.0};
const Pen axis_pen{palette::ink, 0.8, {}};
const Pen grid_pen{{225, 225, 225}, 0.5, {}};

}  // namespace

double y_axis_room_pt(const Axis& y) {
  const Ticks ticks = ticks_between(y.low, y.high, y.ticks_wanted);
  double widest = 0.0;
  for (const double value : ticks.values)
    widest = std::max(widest, text_width_pt(tick_label(value, ticks.step), number_style));
  return widest + tick_pt + 18.0;
}

void draw_axes(Canvas& canvas, const PlotFrame& frame, bool grid) {
  const auto layer = canvas.layer("axes");
  const Rect& r = frame.rect;
  TextStyle number = number_style;
  DrawingPath marks;
  DrawingPath lines;

  const Ticks x_ticks = ticks_between(frame.x.low, frame.x.high, frame.x.ticks_wanted);
  number.anchor = Anchor::middle;
  for (const double value : x_ticks.values) {
    const double at = frame.to_page({value, frame.y.low}).x;
    marks.move_to({at, r.bottom()}).line_to({at, r.bottom() + tick_pt});
    lines.move_to({at, r.y}).line_to({at, r.bottom()});
    canvas.text(tick_label(value, x_ticks.step), {at, r.bottom() + tick_pt + 8.5}, number);
  }
  const Ticks y_ticks = ticks_between(frame.y.low, frame.y.high, frame.y.ticks_wanted);
  number.anchor = Anchor::end;
  for (const double value : y_ticks.values) {
    const double at = frame.to_page({frame.x.low, value}).y;
    marks.move_to({r.x, at}).line_to({r.x - tick_pt, at});
    lines.move_to({r.x, at}).line_to({r.right(), at});
    canvas.text(tick_label(value, y_ticks.step), {r.x - tick_pt - 2.0, at + 3.0}, number);
  }
  if (grid) canvas.stroke(lines, grid_pen);
  canvas.stroke(marks, axis_pen);
  canvas.stroke(r.outline(), axis_pen);

  TextStyle label{.size_pt = 9.0, .anchor = Anchor::middle};
  canvas.text(frame.x.label, {r.x + 0.5 * r.width, r.bottom() + 25.0}, label);
  label.upwards = true;
  canvas.text(frame.y.label, {r.x - y_axis_room_pt(frame.y) + 9.0, r.y + 0.5 * r.height}, label);
}

}  // namespace fairway
