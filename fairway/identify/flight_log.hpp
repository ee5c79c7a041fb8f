// What a vehicle was told and where it went: times, places, courses and commanded courses.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fairway/base/heading.hpp"
#include "fairway/base/vec2.hpp"

namespace fairway {

struct LogSample {
  double time_s = 0.0;
  Vec2 place_m;
  Heading course;        ///< direction of the motion over ground
  Heading command;       ///< in force from this time until the next sample
  std::size_t line = 0;  ///< of the file, from 1
};

struct FlightLog {
  std::string name;  ///< of the file, for messages
  std::vector<LogSample> samples;
};

}  // namespace fairway
