#include "fairway/report/draw_chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/report/legend.hpp"
#include "fairway/report/plot_frame.hpp"
#include "fairway/report/thinned_path.hpp"
#include "fairway/report/ticks.hpp"

namespace fairway {
namespace {

constexpr double margin_pt = 8.0;
constexpr double title_room_pt = 20.0;
constexpr double gap_to_legend_pt = 14.0;

Pen pen_of(const ChartSeries& series, int place) {
  static constexpr std::array<LineStyle, 3> turn{LineStyle::solid, LineStyle::dotted,
                                                 LineStyle::dashed};
  const LineStyle style = series.style.value_or(turn[static_cast<std::size_t>(place) % 3]);
  Pen pen{series_color(place), 1.4, {}};
  if (style == LineStyle::dotted) pen.dash_pt = {1.5, 1.8};
  if (style == LineStyle::dashed) pen.dash_pt = {5.0, 2.0};
  return pen;
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void hold(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// An axis that holds the range with a little air, and something even for no or one value.
Axis axis_of(Range range, const std::string& label, bool from_zero, double air) {
  if (!(range.low <= range.high)) range = {0.0, 1.0};
  if (from_zero) range.hold(0.0);
  double room = air * (range.high - range.low);
  const double size = std::max(std::abs(range.low), std::abs(range.high));
  if (!(range.high - range.low > 1e-9 * size)) room = size > 0.0 ? 0.5 * size : 0.5;
  const bool at_zero = from_zero && range.low == 0.0;
  return {range.low - (at_zero ? 0.0 : room), range.high + room, label, 6};
}

DrawingPath line_of(const ChartSeries& series, const PlotFrame& frame) {
  DrawingPath path;
  bool drawing = false;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const bool finite = std::isfinite(series.x[i]) && std::isfinite(series.y[i]);
    if (finite) {
      const Vec2 at = frame.to_page({series.x[i], series.y[i]});
      drawing ? path.line_to(at) : path.move_to(at);
    }
    drawing = finite;
  }
  return path;
}

}  // namespace

Picture draw_chart(std::span<const ChartSeries> series, const ChartOptions& options) {
  require(options.width_pt >= 150.0 && options.width_pt <= 2000.0 && options.height_pt >= 100.0 &&
              options.height_pt <= 2000.0,
          "a chart is 150..2000 by 100..2000 points");
  require(options.pixels_per_pt >= 0.5 && options.pixels_per_pt <= 8.0,
          "pixels_per_pt is in 0.5..8");
  Range x_range;
  Range y_range;
  std::vector<LegendEntry> entries;
  for (std::size_t k = 0; k < series.size(); ++k) {
    require(series[k].x.size() == series[k].y.size(), "a series has as many y as x");
    for (std::size_t i = 0; i < series[k].x.size(); ++i) {
      if (!std::isfinite(series[k].x[i]) || !std::isfinite(series[k].y[i])) continue;
      x_range.hold(series[k].x[i]);
      y_range.hold(series[k].y[i]);
    }
    entries.push_back(line_entry(series[k].name, pen_of(series[k], static_cast<int>(k))));
  }

  PlotFrame frame;
  frame.x = axis_of(x_range, options.x_label, false, 0.0);
  frame.y = axis_of(y_range, options.y_label, options.y_from_zero, 0.06);
  const double top = margin_pt + (options.title.empty() ? 0.0 : title_room_pt);
  const double legend_room = entries.empty() ? 0.0 : gap_to_legend_pt + legend_width_pt(entries);
  frame.rect.x = margin_pt + y_axis_room_pt(frame.y);
  frame.rect.y = top;
  frame.rect.width = options.width_pt;
  frame.rect.height = options.height_pt;
  const double legend_height = legend_row_pt * static_cast<double>(entries.size());
  const double title_width = text_width_pt(options.title, {.size_pt = 11.0, .bold = true});
  Canvas canvas(
      frame.rect.x + std::max(frame.rect.width + legend_room, title_width) + margin_pt + 6.0,
      top + std::max(frame.rect.height + x_axis_room_pt, legend_height) + margin_pt,
      options.pixels_per_pt, options.title);

  draw_axes(canvas, frame, true);
  for (std::size_t k = 0; k < series.size(); ++k) {
    const auto layer = canvas.layer(fmt::format("series-{}", k + 1), frame.rect);
    canvas.stroke(thinned(line_of(series[k], frame), unseen_pt),
                  pen_of(series[k], static_cast<int>(k)));
  }
  draw_legend(canvas, {frame.rect.right() + gap_to_legend_pt, frame.rect.y + 2.0}, entries);
  if (!options.title.empty()) {
    const auto layer = canvas.layer("title");
    canvas.text(options.title, {frame.rect.x, margin_pt + 11.0}, {.size_pt = 11.0, .bold = true});
  }
  return canvas.finish();
}

}  // namespace fairway
