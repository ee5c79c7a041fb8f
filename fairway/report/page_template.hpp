// The page without a run's data: script and style of web/, bundled when the project was built.
#pragma once

#include <string_view>

namespace fairway {

/// HTML with the marks of page.hpp; or, when the project was built without npm, a sentence saying
/// why there is none.
[[nodiscard]] std::string_view page_template();
[[nodiscard]] bool has_page_template();

}  // namespace fairway
