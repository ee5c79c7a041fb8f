// Parallel strokes over an area given by a predicate, as vectors without a clipping outline: the
// cost and the size depend only on the page, not on the number of cells.
#pragma once

#include <cmath>

#include "fairway/report/canvas.hpp"

namespace fairway {

/// Strokes `spacing_pt` apart within `area`, falling (to the right and down) or rising, wherever
/// `covers(point)`; ends are accurate to half a point.
template <typename Covers>
[[nodiscard]] DrawingPath hatch(const Rect& area, double spacing_pt, bool rising,
                                const Covers& covers) {
  constexpr double stride_pt = 0.5;
  DrawingPath path;
  const double slope = rising ? -1.0 : 1.0;
  const double apart = spacing_pt * std::sqrt(2.0);
  const double first = rising ? area.y : area.y - area.width;
  for (double y0 = first; y0 < first + area.height + area.width; y0 += apart) {
    bool drawing = false;
    Vec2 last;
    for (double x = area.x; x <= area.right(); x += stride_pt) {
      const Vec2 p{x, y0 + slope * (x - area.x)};
      const bool inside = p.y >= area.y && p.y <= area.bottom() && covers(p);
      if (inside && !drawing) path.move_to(p);
      if (!inside && drawing) path.line_to(last);
      drawing = inside;
      last = p;
    }
    if (drawing) path.line_to(last);
  }
  return path;
}

}  // namespace fairway
