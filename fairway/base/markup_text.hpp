// Text of a user within HTML and SVG.
#pragma once

#include <string>
#include <string_view>

namespace fairway {

/// Between tags or in a quoted attribute: none of it becomes markup.
[[nodiscard]] std::string markup_text(std::string_view text);

}  // namespace fairway
