#include "fairway/report/draw_log.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/report/canvas.hpp"
#include "fairway/report/legend.hpp"
#include "fairway/report/plot_frame.hpp"
#include "fairway/report/thinned_path.hpp"

namespace fairway {
namespace {

constexpr double margin_pt = 8.0;
constexpr double title_room_pt = 20.0;
constexpr double gap_pt = 18.0;
constexpr double close_up_tracking = 12.0;  // half the side of the close-up, in tracking distances

const Pen log_pen{palette::ink, 1.2, {}};
const Pen motion_pen{series_color(0), 1.6, {4.0, 2.0}};
const Color worst_color{190, 40, 40};
const Color tube_color{150, 170, 200, 0.35};

/// A square of the world.
PlotFrame square_frame(Vec2 middle, double half_m, double side_pt) {
  PlotFrame frame;
  frame.x = {middle.x - half_m, middle.x + half_m, "x (m)", 5};
  frame.y = {middle.y - half_m, middle.y + half_m, "y (m)", 5};
  frame.rect.width = frame.rect.height = side_pt;
  return frame;
}

PlotFrame whole_frame(const LogPicture& p) {
  Vec2 low = p.log_m.front();
  Vec2 high = low;
  for (const auto* places : {&p.log_m, &p.motion_m}) {
    for (const Vec2 at : *places) {
      low = {std::min(low.x, at.x), std::min(low.y, at.y)};
      high = {std::max(high.x, at.x), std::max(high.y, at.y)};
    }
  }
  const Vec2 size = high - low;
  const double half_m = std::max(0.55 * std::max(size.x, size.y), 2.0 * p.tracking_m);
  return square_frame(0.5 * (low + high), half_m, p.map_pt);
}

DrawingPath path_on(const PlotFrame& frame, const std::vector<Vec2>& places) {
  std::vector<Vec2> points;
  for (const Vec2 place : places) points.push_back(frame.to_page(place));
  return thinned(DrawingPath::polyline(points), unseen_pt);
}

double pt_per_m(const PlotFrame& frame) { return frame.rect.width / (frame.x.high - frame.x.low); }

void draw_tracks(Canvas& canvas, const PlotFrame& frame, const LogPicture& p, const char* name) {
  const auto layer = canvas.layer(name, frame.rect);
  const DrawingPath log = path_on(frame, p.log_m);
  canvas.stroke(log, {tube_color, std::max(0.5, 2.0 * p.tracking_m * pt_per_m(frame)), {}});
  canvas.stroke(log, log_pen);
  if (p.motion_m.size() >= 2) canvas.stroke(path_on(frame, p.motion_m), motion_pen);
}

void draw_whole(Canvas& canvas, const PlotFrame& frame, const LogPicture& p, double close_half_m) {
  draw_axes(canvas, frame, true);
  draw_tracks(canvas, frame, p, "flight");
  const auto layer = canvas.layer("worst", frame.rect);
  canvas.fill(DrawingPath::circle(frame.to_page(p.log_m.front()), 2.6), palette::ink);
  const Vec2 at = frame.to_page(p.log_m[p.worst_sample]);
  canvas.stroke(DrawingPath::circle(at, std::max(5.0, close_half_m * pt_per_m(frame))),
                {worst_color, 1.4, {}});
}

void draw_close_up(Canvas& canvas, const PlotFrame& frame, const LogPicture& p) {
  draw_axes(canvas, frame, true);
  draw_tracks(canvas, frame, p, "close-up");
  const auto layer = canvas.layer("distance", frame.rect);
  const Vec2 at = frame.to_page(p.log_m[p.worst_sample]);
  canvas.stroke(DrawingPath::circle(at, p.tracking_m * pt_per_m(frame)),
                {worst_color, 1.0, {2.5, 2.0}});
  canvas.fill(DrawingPath::circle(at, 2.4), worst_color);
  if (p.worst_sample >= p.motion_m.size()) return;
  const Vec2 motion = frame.to_page(p.motion_m[p.worst_sample]);
  canvas.stroke(DrawingPath::polyline({at, motion}), {worst_color, 1.4, {}});
}

std::vector<LegendEntry> entries_of(const LogPicture& p) {
  return {line_entry("the log", log_pen), line_entry("a motion of the contract", motion_pen),
          area_entry(fmt::format("within {:.3g} m of the log", p.tracking_m), tube_color),
          line_entry(p.worst_name, {worst_color, 1.4, {}})};
}

}  // namespace

Picture draw_log(const LogPicture& p) {
  require(p.log_m.size() >= 2, "a log has at least two places");
  require(p.worst_sample < p.log_m.size(), "the worst sample is one of the log's");
  require(p.tracking_m > 0.0, "the tracking distance is above 0");
  const double top = margin_pt + (p.title.empty() ? 0.0 : title_room_pt);
  const double close_half_m = close_up_tracking * p.tracking_m;
  PlotFrame whole = whole_frame(p);
  PlotFrame close = square_frame(p.log_m[p.worst_sample], close_half_m, p.map_pt);
  whole.rect.x = margin_pt + y_axis_room_pt(whole.y);
  whole.rect.y = close.rect.y = top;
  close.rect.x = whole.rect.right() + gap_pt + y_axis_room_pt(close.y);
  const std::vector<LegendEntry> entries = entries_of(p);
  const double legend_top = whole.rect.bottom() + x_axis_room_pt + 6.0;
  Canvas canvas(close.rect.right() + margin_pt,
                legend_top + legend_row_pt * static_cast<double>(entries.size()) + margin_pt,
                p.pixels_per_pt, p.title);
  draw_whole(canvas, whole, p, close_half_m);
  draw_close_up(canvas, close, p);
  draw_legend(canvas, {whole.rect.x, legend_top}, entries);
  if (!p.title.empty()) {
    const auto layer = canvas.layer("title");
    canvas.text(p.title, {whole.rect.x, margin_pt + 11.0}, {.size_pt = 11.0, .bold = true});
  }
  return canvas.finish();
}

}  // namespace fairway
