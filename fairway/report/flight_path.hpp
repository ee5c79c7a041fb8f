// A flight's track on the page: exact arcs and lines.
#pragma once

#include <span>

#include "fairway/report/plot_frame.hpp"
#include "fairway/simulate/flight.hpp"

namespace fairway {

/// Pieces of equal curvature that follow each other (a turn through several cells) become one.
[[nodiscard]] DrawingPath segments_path(std::span<const FlightSegment> segments,
                                        const PlotFrame& frame);
[[nodiscard]] inline DrawingPath flight_path(const Flight& flight, const PlotFrame& frame) {
  return segments_path(flight.segments, frame);
}

}  // namespace fairway
