// Checks of where a command will write, made before it starts.
#pragma once

#include <filesystem>
#include <vector>

#include "fairway/base/atomic_file.hpp"

namespace fairway {

/// Files to read or to write, as given by options: an empty path means the option was not given, -
/// means standard input or output.
using Places = std::vector<std::filesystem::path>;

/// Throws InputError unless every output can be written, is not an input, and is given only once.
void require_places(const Places& outputs, const Places& inputs, Existing existing);

/// Only those that are files.
[[nodiscard]] Places files_of(Places places);

}  // namespace fairway
