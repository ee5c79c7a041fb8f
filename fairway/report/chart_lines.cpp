#include "fairway/report/chart_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/report/thinned_path.hpp"

namespace fairway {
namespace {

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

/// An axis that holds the range with a small margin; not empty even for no or one value.
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

PlotFrame chart_frame(std::span<const ChartSeries> series, const ChartOptions& options) {
  Range x_range;
  Range y_range;
  for (const ChartSeries& line : series) {
    require(line.x.size() == line.y.size(), "a series has as many y as x");
    for (std::size_t i = 0; i < line.x.size(); ++i) {
      if (!std::isfinite(line.x[i]) || !std::isfinite(line.y[i])) continue;
      x_range.hold(line.x[i]);
      y_range.hold(line.y[i]);
    }
  }
  PlotFrame frame;
  frame.x = axis_of(x_range, options.x_label, false, 0.0);
  frame.y = axis_of(y_range, options.y_label, options.y_from_zero, 0.06);
  return frame;
}

std::vector<LegendEntry> chart_entries(std::span<const ChartSeries> series) {
  std::vector<LegendEntry> entries;
  for (std::size_t k = 0; k < series.size(); ++k) {
    entries.push_back(line_entry(series[k].name, pen_of(series[k], static_cast<int>(k))));
  }
  return entries;
}

void draw_chart_lines(Canvas& canvas, const PlotFrame& frame, std::span<const ChartSeries> series) {
  draw_axes(canvas, frame, true);
  for (std::size_t k = 0; k < series.size(); ++k) {
    const auto layer = canvas.layer(fmt::format("series-{}", k + 1), frame.rect);
    canvas.stroke(thinned(line_of(series[k], frame), unseen_pt),
                  pen_of(series[k], static_cast<int>(k)));
  }
}

}  // namespace fairway
