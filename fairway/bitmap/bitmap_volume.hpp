// The share of the configuration volume that reaches, by a border bitmap (bitmap_lookup.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fairway/bitmap/bitmap_lookup.hpp"
#include "fairway/bitmap/border_bitmap.hpp"
#include "fairway/plan/plan.hpp"

namespace fairway {

struct VolumeShare {
  double reached = 0.0;         ///< of the volume of all cells that are neither region nor obstacle
  double standard_error = 0.0;  ///< of sampling
  std::size_t draws = 0;
};

/// By `draws` random states, seeded; the same for any number of threads. 0 when there is no such
/// cell.
[[nodiscard]] VolumeShare volume_share_reached(const Plan& plan,
                                               const std::vector<std::uint8_t>& target_cells,
                                               const BorderBitmap& set, std::size_t draws,
                                               std::uint64_t seed = 1);

/// The same for a lookup: of the cells that it treats as ordinary.
[[nodiscard]] VolumeShare volume_share_reached(const BitmapLookup& lookup, std::size_t draws,
                                               std::uint64_t seed = 1);

}  // namespace fairway
