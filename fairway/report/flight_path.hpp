// A flight's track on the page: exact arcs and lines.
#pragma once

#include "fairway/report/plot_frame.hpp"
#include "fairway/simulate/flight.hpp"

namespace fairway {

/// Pieces of equal curvature that follow each other (a turn through several cells) become one.
[[nodiscard]] DrawingPath flight_path(const Flight& flight, const PlotFrame& frame);

}  // namespace fairway
