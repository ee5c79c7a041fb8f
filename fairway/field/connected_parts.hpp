// The connected parts of a set of cells. Cells that touch at a corner are connected, as for the
// cost-to-go.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace fairway {

inline constexpr std::uint32_t no_part = static_cast<std::uint32_t>(-1);

struct ConnectedParts {
  std::vector<std::uint32_t> part;  ///< [iy][ix], from 0; no_part outside the set
  std::vector<std::size_t> cells;   ///< of each part

  /// The largest part, the first of several equal ones; no_part when there is none.
  [[nodiscard]] std::uint32_t largest() const;
};

/// `inside`: [iy][ix], nx * ny entries, not zero in the set. Parts are numbered by their lowest
/// cell. Cost: linear in cells.
[[nodiscard]] ConnectedParts connected_parts(std::span<const std::uint8_t> inside, int nx, int ny);

}  // namespace fairway
