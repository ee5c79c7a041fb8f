// The border of the goal's cells, or of others, as few straight lines.
#pragma once

#include <functional>

#include "fairway/plan/plan.hpp"
#include "fairway/report/plot_frame.hpp"

namespace fairway {

/// Every cell side between a goal cell and one that is not, neighbouring sides joined.
[[nodiscard]] DrawingPath goal_outline(const Plan& plan, const PlotFrame& frame);

/// The same for the cells for which `inside` is true; it is also called for cells just outside.
[[nodiscard]] DrawingPath outline_of_cells(const Grid& grid, const PlotFrame& frame,
                                           const std::function<bool(Cell)>& inside);

}  // namespace fairway
