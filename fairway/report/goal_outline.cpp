#include "fairway/report/goal_outline.hpp"

namespace fairway {

DrawingPath goal_outline(const Plan& plan, const PlotFrame& frame) {
  return outline_of_cells(plan.grid, frame, [&](Cell cell) {
    return plan.grid.contains(cell) && plan.region[plan.grid.index(cell)] == Region::goal;
  });
}

DrawingPath outline_of_cells(const Grid& grid, const PlotFrame& frame,
                             const std::function<bool(Cell)>& inside) {
  DrawingPath path;
  const auto line = [&](Cell from, Cell to) {
    path.move_to(frame.to_page(grid.corner(from))).line_to(frame.to_page(grid.corner(to)));
  };
  for (int iy = 0; iy <= grid.ny; ++iy)  // sides between row iy - 1 and row iy
    for (int ix = 0, start = 0; ix <= grid.nx; ++ix) {
      const bool side = ix < grid.nx && inside({ix, iy}) != inside({ix, iy - 1});
      if (side) continue;
      if (start < ix) line({start, iy}, {ix, iy});
      start = ix + 1;
    }
  for (int ix = 0; ix <= grid.nx; ++ix)
    for (int iy = 0, start = 0; iy <= grid.ny; ++iy) {
      const bool side = iy < grid.ny && inside({ix, iy}) != inside({ix - 1, iy});
      if (side) continue;
      if (start < iy) line({ix, start}, {ix, iy});
      start = iy + 1;
    }
  return path;
}

}  // namespace fairway
