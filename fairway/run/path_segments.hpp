// A shortest path as the pieces that flights, files and pictures are made of.
#pragma once

#include <vector>

#include "fairway/simulate/flight.hpp"
#include "fairway/steer/dubins_words.hpp"

namespace fairway {

/// The parts of positive length, joined end to end. Times are left 0: a path has no speed.
[[nodiscard]] std::vector<FlightSegment> segments_of(const DubinsPath& path);

}  // namespace fairway
