#include "fairway/report/draw_chart.hpp"

#include <algorithm>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/report/chart_lines.hpp"

namespace fairway {
namespace {

constexpr double margin_pt = 8.0;
constexpr double title_room_pt = 20.0;
constexpr double gap_to_legend_pt = 14.0;

}  // namespace

Picture draw_chart(std::span<const ChartSeries> series, const ChartOptions& options) {
  require(options.width_pt >= 150.0 && options.width_pt <= 2000.0 && options.height_pt >= 100.0 &&
              options.height_pt <= 2000.0,
          "a chart is 150..2000 by 100..2000 points");
  require(options.pixels_per_pt >= 0.5 && options.pixels_per_pt <= 8.0,
          "pixels_per_pt is in 0.5..8");
  PlotFrame frame = chart_frame(series, options);
  const std::vector<LegendEntry> entries = chart_entries(series);
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

  draw_chart_lines(canvas, frame, series);
  draw_legend(canvas, {frame.rect.right() + gap_to_legend_pt, frame.rect.y + 2.0}, entries);
  if (!options.title.empty()) {
    const auto layer = canvas.layer("title");
    canvas.text(options.title, {frame.rect.x, margin_pt + 11.0}, {.size_pt = 11.0, .bold = true});
  }
  return canvas.finish();
}

}  // namespace fairway
