// The text of a scenario, or of a part of one: every key read on its own, not yet checked against
// the others.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

#include "fairway/run/scenario.hpp"

namespace fairway {

/// Throws InputError{FILE:LINE or option, KEY ... what is expected} for an unknown key and for a
/// value that no scenario may have. Keys may be missing; paths are as given.
[[nodiscard]] Scenario keys_of_text(std::string_view text, const std::filesystem::path& file,
                                    std::span<const ScenarioOverride> overrides = {});

/// Calls `use` with the file's text. Of a file that `use` refuses and that is another kind of file,
/// says which.
void use_toml_file(const std::filesystem::path& file,
                   const std::function<void(std::string_view)>& use);

}  // namespace fairway
