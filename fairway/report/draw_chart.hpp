// A chart of one or more series over a common x axis, with a legend.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fairway/report/picture.hpp"

namespace fairway {

enum class LineStyle { solid, dotted, dashed };

/// One line of a chart. Points that are not finite break the line.
struct ChartSeries {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;           ///< as many as x
  std::optional<LineStyle> style;  ///< default: solid, dotted, dashed, solid, ... in turn
};

struct ChartOptions {
  std::string title = {};
  std::string x_label = {};
  std::string y_label = {};
  bool y_from_zero = false;  ///< let the y axis start at 0 (distances)
  double width_pt = 420.0;
  double height_pt = 240.0;
  double pixels_per_pt = 2.0;
};

/// Throws PreconditionViolation when a series has unequal x and y, or a size is out of range.
[[nodiscard]] Picture draw_chart(std::span<const ChartSeries> series, const ChartOptions& options);

}  // namespace fairway
