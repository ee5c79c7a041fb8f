// Modes: fields of commands over the same cells, of which the vehicle flies one at a time and may
// change to an earlier one (docs/modes.md). Mode 0 is the plan's own.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fairway {

/// The most that a plan may have, its own included.
inline constexpr std::size_t most_modes = 64;

/// In place of a mode's number: none.
inline constexpr std::uint8_t no_mode = 0xff;

}  // namespace fairway
