// How a long run tells where it is.
#pragma once

#include <functional>
#include <string_view>

namespace fairway {

/// Called at the start of a stage and now and then within it, always from the thread that started
/// the work: the stage, and how long the rest of the run will take, a rough estimate in seconds, or
/// unknown_time. May be empty.
using Progress = std::function<void(std::string_view stage, double left_s)>;

inline constexpr double unknown_time = -1.0;

}  // namespace fairway
