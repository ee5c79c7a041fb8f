// What a page knows about verdicts besides their arrays.
#pragma once

#include <string>

#include "fairway/verify/verdict_map.hpp"

namespace fairway {

/// One JSON object: samples, headings, and how many samples have each verdict at each heading.
[[nodiscard]] std::string page_verdicts_json(const VerdictMap& map);

}  // namespace fairway
