// How a long run tells where it is.
#pragma once

#include <functional>
#include <string_view>

namespace fairway {

/// Called at the start of a stage and now and then within it, always from the thread that started
/// the work: the stage, and how long the rest of the run will take, a rough estimate in seconds.
/// May be empty.
using Progress = std::function<void(std::string_view stage, double left_s)>;

}  // namespace fairway
