// A scenario's text with other values, for tools that write scenarios: comments and all that was
// not asked for stay as they are.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "fairway/run/scenario.hpp"

namespace fairway {

/// `text` lies at `file`; the result is to lie in `folder`, from where its paths are named. Each
/// override replaces a value in its line, or adds a line to its table. Where that does not read
/// back as the same scenario (a key within an inline table, for example), the whole is written
/// anew, without comments.
[[nodiscard]] std::string edited_scenario(std::string_view text, const std::filesystem::path& file,
                                          std::span<const ScenarioOverride> overrides,
                                          const std::filesystem::path& folder);

}  // namespace fairway
