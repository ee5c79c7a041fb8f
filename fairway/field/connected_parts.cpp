#include "fairway/field/connected_parts.hpp"

#include <algorithm>
#include <iterator>

#include "fairway/base/error.hpp"
#include "fairway/base/grid.hpp"

namespace fairway {

std::uint32_t ConnectedParts::largest() const {
  const auto most = std::max_element(cells.begin(), cells.end());
  return most == cells.end() ? no_part
                             : static_cast<std::uint32_t>(std::distance(cells.begin(), most));
}

ConnectedParts connected_parts(std::span<const std::uint8_t> inside, int nx, int ny) {
  const Grid grid{nx, ny};
  require(inside.size() == grid.size(), "connected_parts: one entry per cell");
  ConnectedParts parts;
  parts.part.assign(inside.size(), no_part);
  std::vector<std::size_t> waiting;
  for (std::size_t first = 0; first < inside.size(); ++first) {
    if (inside[first] == 0 || parts.part[first] != no_part) continue;
    const auto number = static_cast<std::uint32_t>(parts.cells.size());
    std::size_t count = 0;
    const auto take = [&](std::size_t i) {
      parts.part[i] = number;
      ++count;
      waiting.push_back(i);
    };
    take(first);
    while (!waiting.empty()) {
      const Cell here = grid.cell_at(waiting.back());
      waiting.pop_back();
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const Cell c{here.ix + dx, here.iy + dy};
          if (!grid.contains(c)) continue;
          const std::size_t i = grid.index(c);
          if (inside[i] != 0 && parts.part[i] == no_part) take(i);
        }
      }
    }
    parts.cells.push_back(count);
  }
  return parts;
}

}  // namespace fairway
