// The paper's complete map M (paper 1, Algorithm 1): the class of each cell of the world.
#pragma once

#include <cstdint>

namespace fairway {

enum class Region : std::int8_t {
  buffer = -1,   ///< within alpha * r of an obstacle (Eq. 3)
  free = 0,      ///< safe start: a full turning circle fits on either side
  obstacle = 1,  ///< closed obstacle cell
  goal = 2       ///< wholly inside the goal set (Eq. 4), or crossed by the path (Eq. 5)
};

}  // namespace fairway
