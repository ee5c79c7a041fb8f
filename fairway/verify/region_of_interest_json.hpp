// The region of interest as certificates and bitmaps record it (docs/formats.md).
// Private to the library: nlohmann/json is not part of its interface.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/verify/region_of_interest.hpp"

namespace fairway {

/// "goal", "obstacle", [x0, y0, x1, y1] or "cells": which cells, the file's cell_kind says.
[[nodiscard]] nlohmann::json json_of(const RegionOfInterest& region);

/// `kind`: the file's cells, of which those of a region of cells are the targets. Throws
/// InputError{where, ...} when `value` is no region.
[[nodiscard]] RegionOfInterest region_of_interest_of(const nlohmann::json& value,
                                                     const std::vector<CellKind>& kind,
                                                     const std::string& where);

}  // namespace fairway
