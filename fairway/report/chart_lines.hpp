// The lines of a chart, for pages that hold more than the chart.
#pragma once

#include <span>
#include <vector>

#include "fairway/report/draw_chart.hpp"
#include "fairway/report/legend.hpp"
#include "fairway/report/plot_frame.hpp"

namespace fairway {

/// Axes that hold every finite point, with the labels of the options; the rectangle is left open.
/// Throws PreconditionViolation when a series has unequal x and y.
[[nodiscard]] PlotFrame chart_frame(std::span<const ChartSeries> series,
                                    const ChartOptions& options);

[[nodiscard]] std::vector<LegendEntry> chart_entries(std::span<const ChartSeries> series);

/// Axes with a grid, and a layer "series-K" for each line, K from 1.
void draw_chart_lines(Canvas& canvas, const PlotFrame& frame, std::span<const ChartSeries> series);

}  // namespace fairway
