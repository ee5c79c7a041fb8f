// How a long run reports its progress.
#pragma once

#include <functional>
#include <string_view>

namespace fairway {

inline constexpr double unknown_time = -1.0;

/// How long the work will take from now, seconds; unknown_time if it cannot be estimated.
struct TimeLeft {
  double estimate_s = unknown_time;  ///< a rough estimate
  double limit_s = unknown_time;     ///< until a time limit ends the stage, whatever the estimate
};

/// Called at the start of a stage and now and then within it, always from the thread that started
/// the work. May be empty.
using Progress = std::function<void(std::string_view stage, const TimeLeft& left)>;

}  // namespace fairway
