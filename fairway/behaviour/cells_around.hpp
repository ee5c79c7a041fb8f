// The cells, of the grid or not, that meet the box around two points, grown.
#pragma once

#include <algorithm>

#include "fairway/base/grid.hpp"

namespace fairway {

struct CellRange {
  int x0, x1, y0, y1;
  bool is_one() const { return x0 == x1 && y0 == y1; }
};

inline CellRange cells_around(const Grid& grid, Vec2 a, Vec2 b, double by_m) {
  // As std::floor does, without a call.
  const auto number = [&](double at) {
    const double cells = at / grid.cell_m;
    const auto whole = static_cast<int>(cells);
    return whole - (static_cast<double>(whole) > cells ? 1 : 0);
  };
  return {
      number(std::min(a.x, b.x) - grid.x0_m - by_m), number(std::max(a.x, b.x) - grid.x0_m + by_m),
      number(std::min(a.y, b.y) - grid.y0_m - by_m), number(std::max(a.y, b.y) - grid.y0_m + by_m)};
}

}  // namespace fairway
