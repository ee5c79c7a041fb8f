// How far places lie from a set of cells, on a lattice finer than the nodes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fairway/ceiling/ball_lattice.hpp"

namespace fairway {

/// Beyond this many turn radii distances need not be told apart.
inline constexpr double farthest_distance = 2.0;

/// Positive outside the set, negative inside it, in units, within one unit of the truth as long as
/// it is nearer than `farthest_distance`. Fine places are numbered from 0 at the lower left place
/// of the lattice; `fine` of them, an odd number, lie along each node's square, so that one is the
/// node.
struct SignedDistance {
  int fine = 1;
  double spacing = 0.0;
  int columns = 0;
  int rows = 0;
  int margin = 0;  ///< fine places stored beyond each side
  std::vector<Radius> values;

  [[nodiscard]] int of_node(int x) const { return x * fine + fine / 2; }
  [[nodiscard]] std::ptrdiff_t stride() const { return columns + 2 * margin; }
  [[nodiscard]] const Radius* at(int i, int j) const {
    return values.data() + (j + margin) * stride() + (i + margin);
  }
};

/// `in_set` of each cell, [iy][ix]; what lies beyond them is in the set if `beyond`.
[[nodiscard]] SignedDistance signed_distance(const BallLattice& lattice,
                                             const std::vector<std::uint8_t>& in_set, bool beyond);

}  // namespace fairway
