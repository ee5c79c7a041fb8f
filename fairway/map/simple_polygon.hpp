// Whether rings are simple: edges meet only where neighbours share a corner.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fairway/base/vec2.hpp"

namespace fairway {

/// Edge i runs from vertex i of its ring to the next (the last to the first).
struct EdgeContact {
  std::size_t first_ring = 0;
  std::size_t first_edge = 0;
  std::size_t second_ring = 0;
  std::size_t second_edge = 0;
  Vec2 at;  ///< a common point, in the rings' units
};

/// The first contact found that a simple polygon must not have: within a ring, edges that meet
/// other than as neighbours in their corner; between rings, a crossing (holes may touch). Rings
/// have at least three vertices, neighbours differ. The sign of each turn is exact for the rounded
/// differences of coordinates. Cost: n log n plus the pairs that overlap in x.
[[nodiscard]] std::optional<EdgeContact> find_contact(const std::vector<std::vector<Vec2>>& rings);

}  // namespace fairway
