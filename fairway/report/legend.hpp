// A legend: a column of small samples with their names.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fairway/report/canvas.hpp"

namespace fairway {

struct LegendEntry {
  std::string name;
  std::function<void(Canvas&, const Rect&)> sample;  ///< draws into a box of 22 by 9 points
};

inline constexpr double legend_row_pt = 14.0;

[[nodiscard]] double legend_width_pt(const std::vector<LegendEntry>& entries);

/// From `corner` (top left) down, one row each, as the layer "legend".
void draw_legend(Canvas& canvas, Vec2 corner, const std::vector<LegendEntry>& entries);

/// Ready samples.
[[nodiscard]] LegendEntry line_entry(std::string name, const Pen& pen);
[[nodiscard]] LegendEntry area_entry(std::string name, const Color& color);
/// An area under strokes that rise, fall (to the right), or both.
[[nodiscard]] LegendEntry hatched_entry(std::string name, const Color& ground, const Pen& pen,
                                        bool rising, bool falling);

}  // namespace fairway
