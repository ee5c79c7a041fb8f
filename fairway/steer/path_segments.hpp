// A shortest path as the pieces that flights, files and pictures are made of.
#pragma once

#include <vector>

#include "fairway/simulate/flight.hpp"
#include "fairway/steer/dubins_words.hpp"

namespace fairway {

/// The parts longer than nothing, joined end to end. Their times are 0: a path has no speed.
[[nodiscard]] std::vector<FlightSegment> segments_of(const DubinsPath& path);

}  // namespace fairway
