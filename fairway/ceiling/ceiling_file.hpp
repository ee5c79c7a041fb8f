// A ceiling as a safetensors file (docs/formats.md).
#pragma once

#include <filesystem>
#include <vector>

#include "fairway/base/atomic_file.hpp"
#include "fairway/ceiling/ceiling.hpp"
#include "fairway/map/region.hpp"

namespace fairway {

/// With the cells that it is of, `region` [iy][ix].
void write_ceiling(const Ceiling& ceiling, const std::vector<Region>& region,
                   const std::filesystem::path& file, Existing existing);

}  // namespace fairway
