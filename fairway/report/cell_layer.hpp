// A plan's cells as pixels: regions and, optionally, the cost to go as shading.
#pragma once

#include "fairway/plan/plan.hpp"
#include "fairway/report/canvas.hpp"

namespace fairway {

struct CellLayer {
  Raster raster;
  int cells_per_pixel = 1;  ///< along each axis; above 1, colours are means over the cells
};

/// Free without a way to the goal: walled off.
[[nodiscard]] bool is_unreachable(const Plan& plan, std::size_t cell);

/// The largest finite cost of a free cell; 0 if there is none.
[[nodiscard]] double largest_cost_m(const Plan& plan);

/// At most `most_pixels` along either side. Shades by cost when `cost` is set.
[[nodiscard]] CellLayer cell_layer(const Plan& plan, bool cost, int most_pixels);

}  // namespace fairway
