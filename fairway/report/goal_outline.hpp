// The border of the goal's cells, as few straight lines.
#pragma once

#include "fairway/plan/plan.hpp"
#include "fairway/report/plot_frame.hpp"

namespace fairway {

/// Every cell side between a goal cell and one that is not, neighbouring sides joined.
[[nodiscard]] DrawingPath goal_outline(const Plan& plan, const PlotFrame& frame);

}  // namespace fairway
