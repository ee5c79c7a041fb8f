// Where a command is about to write, looked at before it begins.
#pragma once

#include <filesystem>
#include <vector>

#include "fairway/base/atomic_file.hpp"

namespace fairway {

/// Files to read or to write, as options name them: empty ones are not asked for, and - is standard
/// input or output.
using Places = std::vector<std::filesystem::path>;

/// Throws InputError unless each output can be written, none is an input, and no two are the same.
void require_places(const Places& outputs, const Places& inputs, Existing existing);

/// Those that are files.
[[nodiscard]] Places files_of(Places places);

}  // namespace fairway
