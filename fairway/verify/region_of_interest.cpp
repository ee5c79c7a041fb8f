#include "fairway/verify/region_of_interest.hpp"

#include <algorithm>

#include "fairway/base/error.hpp"

namespace fairway {

std::vector<CellKind> cell_kinds(const Grid& grid, const std::vector<Region>& region,
                                 const RegionOfInterest& interest) {
  using Of = RegionOfInterest::Kind;
  std::vector<CellKind> kind(grid.size(), CellKind::ordinary);
  require(interest.kind != Of::cells || interest.cells.size() == kind.size(),
          "a region of cells has one entry per cell");
  const auto& [x0, y0, x1, y1] = interest.rectangle_m;
  for (std::size_t i = 0; i < kind.size(); ++i) {
    if (region[i] == Region::obstacle) {
      kind[i] = interest.kind == Of::obstacle ? CellKind::target : CellKind::obstacle;
    } else if (interest.kind == Of::goal) {
      if (region[i] == Region::goal) kind[i] = CellKind::target;
    } else if (interest.kind == Of::rectangle) {
      const Vec2 low = grid.corner(grid.cell_at(i));
      const Vec2 high{low.x + grid.cell_m, low.y + grid.cell_m};
      if (low.x >= x0 && low.y >= y0 && high.x <= x1 && high.y <= y1) kind[i] = CellKind::target;
    } else if (interest.kind == Of::cells && interest.cells[i] != 0) {
      kind[i] = CellKind::target;
    }
  }
  return kind;
}

std::vector<std::uint8_t> target_cells(const Grid& grid, const std::vector<Region>& region,
                                       const RegionOfInterest& interest) {
  const std::vector<CellKind> kind = cell_kinds(grid, region, interest);
  std::vector<std::uint8_t> target(kind.size());
  std::transform(kind.begin(), kind.end(), target.begin(),
                 [](CellKind k) { return std::uint8_t{k == CellKind::target}; });
  return target;
}

}  // namespace fairway
