// One input for one reader, as the fuzzers and the corpus test give it: a value or an InputError,
// anything else is a bug.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace fairway {

/// Names of the readers that can be fed; a folder of the corpus each.
[[nodiscard]] std::span<const std::string_view> readers_to_feed();

/// Puts `bytes` into a file and reads it. "read", or the message of the InputError; any other
/// exception passes.
std::string feed(std::string_view reader, std::string_view bytes);

}  // namespace fairway
