// Feeds one input to one reader, for the fuzzers and the corpus test: the result is a value or an
// InputError, anything else is a bug.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace fairway {

/// Names of the readers that can be fed; each has a folder in the corpus.
[[nodiscard]] std::span<const std::string_view> readers_to_feed();

/// Writes `bytes` to a file and reads it. Returns "read", or the message of the InputError; any
/// other exception propagates.
std::string feed(std::string_view reader, std::string_view bytes);

}  // namespace fairway
