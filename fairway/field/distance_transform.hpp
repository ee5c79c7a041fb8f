// Exact Euclidean distance transform of a binary grid, with the nearest feature of every cell.
//
// Distances are between cell centres, in cells; their squares are integers, so nothing is rounded.
// Properties that always hold:
//   1. squared_cells[c] is the least (dx^2 + dy^2) over all features; 0 on a feature.
//   2. nearest[c] is a feature at exactly that distance.
//   3. Without features every distance is `no_feature_distance` and nearest is `no_feature`.
//   4. Results do not depend on the number of threads.
// Method: a scan of the columns, then the lower envelope of parabolas along each row (Maurer, Qi
// and Raghavan 2003; Meijster, Roerdink and Hesselink 2000). Cost: linear in cells: one pass over
// memory downwards, one upwards, one along rows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace fairway {

inline constexpr std::uint32_t no_feature = std::numeric_limits<std::uint32_t>::max();
inline constexpr std::int32_t no_feature_distance = std::numeric_limits<std::int32_t>::max();

/// The longest side of a grid for which squared distances fit their type.
inline constexpr int largest_distance_side = 32767;

/// The outputs to compute: an empty span is skipped.
struct DistanceOutput {
  std::span<std::int32_t> squared_cells;  ///< [iy][ix]
  std::span<std::uint32_t> nearest;       ///< [iy][ix], flat index of the nearest feature
};

/// `feature`: [iy][ix], nx * ny entries, nonzero at features. Sides up to
/// largest_distance_side, else PreconditionViolation.
void distance_transform(std::span<const std::uint8_t> feature, int nx, int ny,
                        const DistanceOutput& output);

}  // namespace fairway
