// For tests: how often the program has asked for memory.
#pragma once

#include <cstddef>

namespace fairway::testing {

[[nodiscard]] std::size_t heap_uses();

}  // namespace fairway::testing
